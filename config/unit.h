#pragma once
#include <string_view>

namespace eddy {

/// The unit that the end of a key's name stands for: "s" for "preset_s", "m/s" for "velocity_m_s"; empty for none.
std::string_view unit_of(std::string_view key);

}  // namespace eddy
