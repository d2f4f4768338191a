#include "hal/display/kms/edid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace eddy::kms {
namespace {

constexpr std::array<std::uint8_t, 8> kHeader{0x00, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x00};
constexpr std::size_t kBlock = 128, kFirstDescriptor = 54, kDescriptor = 18, kDescriptors = 4;
constexpr std::size_t kText = 5, kTextLength = 13;  // within a descriptor
constexpr std::uint8_t kProductName = 0xfc;

}  // namespace

std::string monitor_name(std::span<const std::uint8_t> edid) {
    if (edid.size() < kBlock || !std::equal(kHeader.begin(), kHeader.end(), edid.begin())) return "";
    for (std::size_t i = 0; i < kDescriptors; ++i) {
        const auto descriptor = edid.subspan(kFirstDescriptor + i * kDescriptor, kDescriptor);
        if (descriptor[0] != 0 || descriptor[1] != 0 || descriptor[3] != kProductName) continue;
        std::string name;
        for (const std::uint8_t byte : descriptor.subspan(kText, kTextLength)) {
            if (byte == '\n') break;
            if (byte >= 0x20 && byte < 0x7f) name += static_cast<char>(byte);
        }
        while (name.ends_with(' ')) name.pop_back();
        if (!name.empty()) return name;
    }
    // Three letters of five bits, A is 1; then the product's number, low byte first.
    const unsigned maker = edid[8] * 256U + edid[9];
    std::string name;
    for (const unsigned shift : {10U, 5U, 0U})
        name += static_cast<char>('A' + static_cast<int>((maker >> shift & 31U)) - 1);
    return fmt::format("{} {:04x}", name, edid[10] + edid[11] * 256U);
}

std::string monitor_id(std::span<const std::uint8_t> edid) {
    if (edid.empty()) return "";
    std::uint64_t hash = 14695981039346656037U;  // FNV-1a
    for (const std::uint8_t byte : edid) hash = (hash ^ byte) * 1099511628211U;
    return fmt::format("{:016x}", hash);
}

}  // namespace eddy::kms
