#include "firmware/disk.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace eddy {
namespace {

[[noreturn]] void fail(const char* what, int reason = errno) {
    throw std::system_error(reason, std::generic_category(), what);
}

class RealDisk final : public Disk {
  public:
    void write(const std::filesystem::path& file, std::string_view bytes) override {
        const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
        if (out < 0) fail("created");
        while (!bytes.empty()) {
            const ssize_t written = ::write(out, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) {
                const int reason = errno;
                ::close(out);
                fail("written", reason);
            }
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        const int reason = ::fsync(out) == 0 ? 0 : errno;
        if (::close(out) != 0) fail("written to the disk");
        if (reason != 0) fail("written to the disk", reason);
    }

    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
        if (::rename(from.c_str(), to.c_str()) != 0) fail("replaced");
    }

    void remove(const std::filesystem::path& file) override {
        if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail("removed");
    }

    void make_folder(const std::filesystem::path& folder) override {
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        if (error) throw std::system_error(error, "made");
    }

    void flush_folder(const std::filesystem::path& folder) override {
        const int opened = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        // One that may be written to but not read, or whose file system knows no such thing, is left to it.
        if (opened < 0 && errno == EACCES) return;
        if (opened < 0) fail("written to the disk");
        const int reason = ::fsync(opened) == 0 ? 0 : errno;
        ::close(opened);
        if (reason != 0 && reason != EINVAL && reason != ENOTSUP) fail("written to the disk", reason);
    }
};

}  // namespace

Disk& real_disk() {
    static RealDisk disk;
    return disk;
}

}  // namespace eddy
