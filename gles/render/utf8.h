#pragma once
#include <string>
#include <string_view>

namespace eddy::gles {

/// What stands for a byte that is not UTF-8.
inline constexpr char32_t kReplacement = 0xFFFD;

/// The code points of a text. Whatever the bytes: each one that belongs to no code point (RFC 3629: no longer forms
/// than needed, no surrogates, nothing above 10FFFF) becomes kReplacement.
std::u32string code_points(std::string_view utf8);

}  // namespace eddy::gles
