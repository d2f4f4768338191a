#include "firmware/exhibit/process_age.h"

#include <time.h>
#include <unistd.h>

#include <charconv>
#include <stdexcept>

#include "firmware/text_file.h"

namespace eddy {
namespace {

/// proc(5): the 22nd field; the second is the program's name in brackets, which may hold anything.
constexpr int kFieldsAfterName = 20;

}  // namespace

std::optional<long long> start_ticks(std::string_view stat) {
    std::size_t at = stat.rfind(')');
    for (int n = 0; n < kFieldsAfterName && at != stat.npos; ++n) at = stat.find(' ', at + 1);
    if (at == stat.npos) return std::nullopt;
    const std::string_view field = stat.substr(at + 1);
    long long ticks = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), ticks);
    if (error != std::errc() || end == field.data()) return std::nullopt;
    return ticks;
}

std::optional<Seconds> process_age() {
    try {
        const auto ticks = start_ticks(read_text_file("/proc/self/stat"));
        timespec now{};
        if (!ticks || clock_gettime(CLOCK_BOOTTIME, &now) != 0) return std::nullopt;
        const double since_boot_s = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
        return Seconds(since_boot_s -
                       static_cast<double>(*ticks) / static_cast<double>(sysconf(_SC_CLK_TCK)));
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

}  // namespace eddy
