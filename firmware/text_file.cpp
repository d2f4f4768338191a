#include "firmware/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace eddy {

std::string read_text_file(const std::filesystem::path& file) {
    const auto fail = [&](int reason) {
        throw std::runtime_error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(reason)));
    };
    // A folder opens like a file and fails only when it is read.
    if (is_folder(file)) fail(EISDIR);
    std::ifstream in(file, std::ios::binary);
    if (!in) fail(errno);
    std::string text(std::istreambuf_iterator<char>(in), {});
    if (in.bad()) fail(EIO);
    return text;
}

void replace_text_file(const std::filesystem::path& file, std::string_view text, Disk& disk) {
    std::filesystem::path beside = file;
    beside += ".new";
    try {
        disk.write(beside, text);
        disk.rename(beside, file);
        disk.flush_folder(file.parent_path());
    } catch (const std::system_error& error) {
        // "created: No such file": the system's own words come last.
        const std::string what = error.what();
        try {
            disk.remove(beside);
        } catch (const std::system_error&) {  // the first trouble counts
        }
        throw std::runtime_error(fmt::format("{}: cannot be {}", file.string(), what));
    }
}

bool is_folder(const std::filesystem::path& folder) {
    std::error_code error;
    return std::filesystem::is_directory(folder, error);
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

}  // namespace eddy
