#include "firmware/exhibit/vital_signs.h"

#include <algorithm>
#include <fstream>

namespace eddy {

std::optional<double> temperature_c(const std::filesystem::path& folder) {
    std::optional<double> hottest;
    std::error_code error;
    for (std::filesystem::directory_iterator zone(folder, error), end; !error && zone != end;
         zone.increment(error)) {
        double milli = 0.0;
        if (!zone->path().filename().string().starts_with("thermal_zone")) continue;
        if (std::ifstream(zone->path() / "temp") >> milli) hottest = std::max(hottest.value_or(milli), milli);
    }
    if (hottest) *hottest /= 1000.0;
    return hottest;
}

}  // namespace eddy
