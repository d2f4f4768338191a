#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace eddy::kms {

// What a monitor says of itself (VESA E-EDID standard, release A: blocks of 128 bytes; the first has four descriptors of 18
// bytes from byte 54 on).

/// The product name of a descriptor of type 0xFC, else the maker's three letters and the product number; empty if these
/// bytes are no EDID.
std::string monitor_name(std::span<const std::uint8_t> edid);

/// 16 hexadecimal digits that tell one monitor from another; empty if there are no bytes.
std::string monitor_id(std::span<const std::uint8_t> edid);

}  // namespace eddy::kms
