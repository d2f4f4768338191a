#pragma once
#include <string>
#include <string_view>

namespace eddy {

/// The SHA-256 of these bytes, as sha256sum writes it: 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace eddy
