#include "firmware/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

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

void replace_text_file(const std::filesystem::path& file, std::string_view text) {
    std::filesystem::path beside = file;
    beside += ".new";
    const auto fail = [&](const char* what) {
        const int reason = errno;
        ::unlink(beside.c_str());
        throw std::runtime_error(
            fmt::format("{}: cannot be {}: {}", file.string(), what, std::strerror(reason)));
    };
    const int out = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (out < 0) fail("created");
    while (!text.empty()) {
        const ssize_t written = ::write(out, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            ::close(out);
            fail("written");
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    const bool flushed = ::fsync(out) == 0;
    if (::close(out) != 0 || !flushed) fail("written to the disk");
    if (::rename(beside.c_str(), file.c_str()) != 0) fail("replaced");
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
