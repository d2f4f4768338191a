#include "firmware/exhibit/crash_record.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "firmware/built_from.h"
#include "firmware/dated_files.h"
#include "firmware/haptic/flight_file.h"
#include "firmware/text_file.h"
#include "firmware/utc_stamp.h"

namespace eddy {
namespace {

namespace fs = std::filesystem;

/// All there is of it; a crash writes no sum.
std::string bytes_of(const fs::path& file) {
    try {
        return read_text_file(file);
    } catch (const std::runtime_error&) {
        return "";
    }
}

constexpr std::array kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::string_view kPending = "crash.pending", kPrefix = "crash-";
/// Between the text and what the recorder has in memory.
constexpr std::string_view kMemory = "\n-- memory of the flight recorder --\n";

/// What the handler needs; one in a process.
struct Crash {
    std::atomic<int> fd{-1};
    std::atomic<const LineRing*> lines{nullptr};
    std::atomic<const FlightRecorder*> flights{nullptr};
    std::atomic<long> started_s{0};
    std::array<char, 200> build{};
    std::size_t build_length = 0;
    std::atomic_flag taken = ATOMIC_FLAG_INIT;
    std::array<struct sigaction, kSignals.size()> before{};
    /// For a stack that is used up: that of the thread that made the record.
    std::array<char, 65536> stack{};
};
Crash g_crash;

void say(int fd, std::string_view text) {
    static_cast<void>(!::write(fd, text.data(), text.size()));
}

void say_number(int fd, long number) {
    char digits[24];
    std::size_t at = sizeof(digits);
    unsigned long rest = number < 0 ? 0UL : static_cast<unsigned long>(number);
    do digits[--at] = static_cast<char>('0' + rest % 10);
    while ((rest /= 10) > 0);
    say(fd, {digits + at, sizeof(digits) - at});
}

long monotonic_s() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec;
}

std::string_view name_of(int signal) {
    switch (signal) {
        case SIGSEGV:
            return "SEGV";
        case SIGBUS:
            return "BUS";
        case SIGFPE:
            return "FPE";
        case SIGILL:
            return "ILL";
        case SIGABRT:
            return "ABRT";
        default:
            return "?";
    }
}

/// Async-signal-safe. It is called once for each signal (SA_RESETHAND): should it fail by the same, the program ends, with what was
/// written before.
void on_crash(int signal) {
    const int fd = g_crash.fd.load();
    if (fd >= 0 && !g_crash.taken.test_and_set()) {
        say(fd, "signal ");
        say_number(fd, signal);
        say(fd, " ");
        say(fd, name_of(signal));
        say(fd, "\nuptime_s ");
        say_number(fd, monotonic_s() - g_crash.started_s.load());
        say(fd, "\nbuild ");
        say(fd, {g_crash.build.data(), g_crash.build_length});
        say(fd, "\n\n");
        if (const LineRing* lines = g_crash.lines.load()) lines->write_to(fd);
        say(fd, kMemory);
        if (const FlightRecorder* flights = g_crash.flights.load()) flights->write_raw(fd);
        ::fsync(fd);
    }
    ::raise(signal);  // blocked until this returns; then the default action
}

}  // namespace

CrashRecord::CrashRecord(const fs::path& folder, const LineRing& lines) : file_(folder / kPending) {
    fd_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
    const std::string build = fmt::format("{} {}", EDDY_VERSION, kBuiltFrom);
    g_crash.build_length = std::min(build.size(), g_crash.build.size());
    std::copy_n(build.begin(), g_crash.build_length, g_crash.build.begin());
    g_crash.started_s = monotonic_s();
    g_crash.lines = &lines;
    g_crash.flights = nullptr;
    g_crash.taken.clear();
    g_crash.fd = fd_;
    stack_t stack{};
    stack.ss_sp = g_crash.stack.data();
    stack.ss_size = g_crash.stack.size();
    sigaltstack(&stack, nullptr);
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        struct sigaction action {};
        action.sa_handler = on_crash;
        action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
        sigaction(kSignals[i], &action, &g_crash.before[i]);
    }
}

CrashRecord::~CrashRecord() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &g_crash.before[i], nullptr);
    g_crash.fd = -1;
    g_crash.lines = nullptr;
    g_crash.flights = nullptr;
    if (fd_ < 0) return;
    ::close(fd_);
    std::error_code ignored;
    fs::remove(file_, ignored);
}

void CrashRecord::watch(const FlightRecorder* flights) {
    g_crash.flights = flights;
}

std::vector<std::string> CrashRecord::take_over(const fs::path& folder) {
    std::vector<std::string> said;
    const fs::path pending = folder / kPending;
    const std::string bytes = bytes_of(pending);
    std::error_code error;
    if (bytes.empty()) {
        fs::remove(pending, error);
        return said;
    }
    const std::size_t split = bytes.find(kMemory);
    const std::string text = bytes.substr(0, split);
    const std::string memory = split == std::string::npos ? "" : bytes.substr(split + kMemory.size());
    const std::string stem = std::string(kPrefix) + utc_stamp("%Y%m%dT%H%M%SZ");
    try {
        const fs::path record = unused_file(folder, stem, ".txt");
        replace_text_file(record, text);
        said.push_back(fmt::format("the program ended badly ({}); what it knew then is in {}",
                                   text.substr(0, text.find('\n')), record.string()));
        // The law has to be the one that flew: it is rerun bit for bit.
        const bool same =
            text.find(fmt::format("\nbuild {} {}\n", EDDY_VERSION, kBuiltFrom)) != std::string::npos;
        if (auto flight = same ? FlightRecorder::read_raw(memory) : std::nullopt) {
            flight->version = EDDY_VERSION;
            flight->written = utc_stamp();
            const fs::path file = unused_file(folder, stem, ".flight");
            replace_text_file(file, flight_text(*flight));
            said.back() += fmt::format(
                ", and the last seconds of the hand in {}: eddy replay runs them again", file.string());
            keep_newest(dated_files(folder, kPrefix, ".flight"), kMostKept, file);
        }
        keep_newest(dated_files(folder, kPrefix, ".txt"), kMostKept, record);
        fs::remove(pending, error);
    } catch (const std::exception& e) {
        said.push_back(fmt::format("the record of a crash could not be kept: {}", e.what()));
    }
    return said;
}

}  // namespace eddy
