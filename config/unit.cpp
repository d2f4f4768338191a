#include "config/unit.h"

#include <utility>

namespace eddy {
namespace {

// The longest end comes first: "_m_s" before "_s".
constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
    {"_units_per_nm", "units/(N m)"},
    {"_kg_m3", "kg/m³"},
    {"_rad_s", "rad/s"},
    {"_ns_m", "N s/m"},
    {"_m_s2", "m/s²"},
    {"_m2_s", "m²/s"},
    {"_pa_s", "Pa s"},
    {"_m_s", "m/s"},
    {"_n_s", "N/s"},
    {"_1_s", "1/s"},
    {"_1_m", "1/m"},
    {"_1_k", "1/K"},
    {"_deg", "°"},
    {"_rad", "rad"},
    {"_min", "min"},
    {"_ms", "ms"},
    {"_mm", "mm"},
    {"_px", "px"},
    {"_hz", "Hz"},
    {"_nm", "N m"},
    {"_kg", "kg"},
    {"_n", "N"},
    {"_s", "s"},
    {"_m", "m"},
    {"_g", "g"},
    {"_v", "V"},
    {"_k", "K"},
    {"_h", "h"},
};

}  // namespace

std::string_view unit_of(std::string_view key) {
    for (const auto& [end, unit] : kUnits)
        if (key.ends_with(end)) return unit;
    return "";
}

}  // namespace eddy
