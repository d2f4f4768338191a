#include "firmware/exhibit/state_file.h"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "config/sha256.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

constexpr std::string_view kSum = "sha256 ";

std::string sum_line(std::string_view text) {
    return fmt::format("{}{}\n", kSum, sha256(text));
}

}  // namespace

StateFile::StateFile(std::filesystem::path file, Disk& disk) : file_(std::move(file)), disk_(disk) {}

std::optional<std::string> StateFile::read() {
    std::error_code error;
    if (!std::filesystem::exists(file_, error) && !error) return std::nullopt;
    try {
        const std::string text = read_text_file(file_);
        if (const std::size_t at = text.rfind(kSum); at != std::string::npos)
            if (text.substr(at) == sum_line(text.substr(0, at))) return text.substr(0, at);
    } catch (const std::runtime_error&) {  // counted like one that is torn
    }
    ++unreadable_;
    return std::nullopt;
}

void StateFile::write(std::string_view text) {
    const std::filesystem::path folder = file_.parent_path();
    if (!is_folder(folder)) {
        try {
            disk_.make_folder(folder);
            disk_.flush_folder(folder.parent_path());
        } catch (const std::system_error& error) {
            throw std::runtime_error(fmt::format("{}: cannot be {}", folder.string(), error.what()));
        }
    }
    replace_text_file(file_, fmt::format("{}{}", text, sum_line(text)), disk_);
}

bool StateFile::try_write(std::string_view text) {
    try {
        write(text);
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

void StateFile::remove() {
    std::error_code none;
    if (!std::filesystem::exists(file_, none)) return;
    try {
        disk_.remove(file_);
        disk_.flush_folder(file_.parent_path());
    } catch (const std::system_error& error) {
        throw std::runtime_error(fmt::format("{}: cannot be {}", file_.string(), error.what()));
    }
}

}  // namespace eddy
