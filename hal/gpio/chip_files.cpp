#include "hal/gpio/chip_files.h"

#include <fmt/format.h>
#include <grp.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>
#include <system_error>

namespace eddy {
namespace {

std::optional<int> number_of(const std::filesystem::path& file) {
    constexpr std::string_view kPrefix = "gpiochip";
    const std::string name = file.filename().string();
    if (!name.starts_with(kPrefix)) return std::nullopt;
    int number = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + kPrefix.size(), end, number);
    if (error != std::errc{} || rest != end) return std::nullopt;
    return number;
}

}  // namespace

std::vector<std::filesystem::path> chip_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
        if (number_of(i->path())) files.push_back(i->path());
    std::sort(files.begin(), files.end(),
              [](const auto& a, const auto& b) { return *number_of(a) < *number_of(b); });
    return files;
}

std::string why_not_opened(const std::filesystem::path& file, int error) {
    if (error != EACCES && error != EPERM)
        return fmt::format("cannot be opened: {}", std::generic_category().message(error));
    struct stat status {};
    const bool known = stat(file.c_str(), &status) == 0;
    const group* owner = known ? getgrgid(status.st_gid) : nullptr;
    if (known && status.st_gid != 0 && owner && (status.st_mode & S_IRGRP) != 0)
        return fmt::format("this user may not open it: usermod -aG {} USER, and log in anew", owner->gr_name);
    return "this user may not open it, nor any group: install the udev rule 60-eddy.rules";
}

}  // namespace eddy
