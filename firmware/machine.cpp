#include "firmware/machine.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace eddy {

std::string describe_machine() {
    std::string model = "unknown processor", line;
    for (std::ifstream info("/proc/cpuinfo"); std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) {
            model = line.substr(line.find(':') + 2);
            break;
        }
    const double bytes =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return fmt::format("{}, {} cores, {:.0f} GB", model, std::thread::hardware_concurrency(), bytes / 1e9);
}

std::string date_and_time() {
    return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace eddy
