#include "gles/render/utf8.h"

#include <array>
#include <cstdint>

namespace eddy::gles {
namespace {

/// Bytes of the code point that begins with this one; 0: none does.
std::size_t length_of(std::uint8_t lead) {
    if (lead < 0x80) return 1;
    if (lead < 0xC2) return 0;  // goes on with another, or a longer form than needed
    return lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
}

struct First {
    char32_t point = kReplacement;
    std::size_t length = 1;
};

First first_of(std::string_view text) {
    const auto lead = static_cast<std::uint8_t>(text[0]);
    const std::size_t length = length_of(lead);
    if (length == 1) return {lead, 1};
    if (length == 0 || length > text.size()) return {};
    char32_t point = lead & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        const auto byte = static_cast<std::uint8_t>(text[i]);
        if ((byte & 0xC0) != 0x80) return {};
        point = point << 6 | (byte & 0x3Fu);
    }
    constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
    if (point < kLeast[length] || point > 0x10FFFF || surrogate) return {};
    return {point, length};
}

}  // namespace

std::u32string code_points(std::string_view utf8) {
    std::u32string points;
    while (!utf8.empty()) {
        const First first = first_of(utf8);
        points.push_back(first.point);
        utf8.remove_prefix(first.length);
    }
    return points;
}

}  // namespace eddy::gles
