#include "firmware/utc_stamp.h"

#include <ctime>

namespace eddy {

std::string utc_stamp(const char* format) {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[40];
    return {text, std::strftime(text, sizeof(text), format, &utc)};
}

}  // namespace eddy
