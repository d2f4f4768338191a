#include "config/written_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "config/diagnostic.h"
#include "config/sha256.h"

namespace eddy {
namespace {

constexpr std::string_view kSumsName = ".sha256";
constexpr std::size_t kSumDigits = 64;

[[noreturn]] void refuse(const Place& place, std::string message) {
    throw ConfigError({diagnose(place, "", std::move(message))});
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::string message) {
    refuse(Place{path.string(), 0, 0}, std::move(message));
}

class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }

  private:
    int fd_;
};

Place end_of(const std::filesystem::path& path, std::string_view text) {
    const std::size_t last = text.rfind('\n');
    const std::size_t column = last == std::string_view::npos ? text.size() : text.size() - last - 1;
    return {path.string(), static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1,
            static_cast<int>(column) + 1};
}

void check_whole(const std::filesystem::path& path, std::string_view text) {
    if (text.empty())
        refuse(path, "is empty; if nothing shall be set here write a comment into it, or delete it");
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
        refuse(end_of(path, text.substr(0, zero)),
               "a byte of 0, as a power cut leaves it; write the file again");
    if (text.back() != '\n')
        refuse(end_of(path, text), "seems to be cut off; if it is whole, end its last line");
}

void check_sum(const std::filesystem::path& path, std::string_view text, const WrittenFile& sum) {
    const std::string wanted = sum.text.substr(0, kSumDigits);
    if (wanted == sha256(text)) return;
    refuse(path, fmt::format("is not what {} says; copy both again, or delete {}", sum.path.string(),
                             sum.path.filename().string()));
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& path, Links links, std::size_t most) {
    // A pipe must not make the reader wait.
    const Descriptor file(
        ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | (links == Links::Refuse ? O_NOFOLLOW : 0)));
    if (file.get() < 0 && errno == ELOOP && links == Links::Refuse)
        refuse(path, "is a symbolic link; here only plain files count: copy the file itself");
    const auto unreadable = [&] { refuse(path, fmt::format("cannot be read: {}", std::strerror(errno))); };
    if (file.get() < 0) unreadable();
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) unreadable();
    if (S_ISDIR(status.st_mode)) refuse(path, "cannot be read: it is a folder");
    if (!S_ISREG(status.st_mode)) refuse(path, "cannot be read: it is no plain file");
    std::string text;
    char piece[1 << 16];
    while (text.size() <= most) {
        const ssize_t count = ::read(file.get(), piece, sizeof(piece));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) unreadable();
        if (count == 0) return text;
        text.append(piece, static_cast<std::size_t>(count));
    }
    refuse(path, fmt::format("is larger than {} KiB", most / 1024));
}

std::string read_written_file(const std::filesystem::path& path, Links links,
                              std::vector<WrittenFile>& read) {
    const std::string text = read_whole_file(path, links, kMostConfigBytes);
    read.push_back({path, text});
    check_whole(path, text);
    std::filesystem::path sums = path;
    sums += kSumsName;
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::symlink_status(sums, none))) {
        read.push_back({sums, read_whole_file(sums, links, kMostConfigBytes)});
        check_sum(path, text, read.back());
    }
    return text;
}

}  // namespace eddy
