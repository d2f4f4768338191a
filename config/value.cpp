#include "config/value.h"

#include <cmath>

namespace eddy {

std::string to_string(const Range& range) {
    std::string out;
    if (std::isfinite(range.low))
        out = fmt::format("{} {}", range.low_excluded ? "above" : "at least", range.low);
    if (std::isfinite(range.high)) out += fmt::format("{}at most {}", out.empty() ? "" : " and ", range.high);
    return out;
}

std::string to_toml(bool value) {
    return value ? "true" : "false";
}
std::string to_toml(int value) {
    return fmt::format("{}", value);
}
std::string to_toml(double value) {
    return fmt::format("{}", value);
}
std::string to_toml(const glm::ivec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string to_toml(const glm::dvec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string to_toml(const Formula& value) {
    return value.source() ? in_quotes(*value.source()) : to_toml(*value.constant());
}
std::string to_toml(const FormulaVector& v) {
    return fmt::format("[{}, {}, {}]", to_toml(v.x), to_toml(v.y), to_toml(v.z));
}
std::string to_toml(const std::string& value) {
    return in_quotes(value);
}
std::string to_toml(const std::filesystem::path& value) {
    return in_quotes(value.string());
}

}  // namespace eddy
