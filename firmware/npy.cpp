#include "firmware/npy.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "firmware/text_file.h"

namespace eddy {

void write_npy(const std::filesystem::path& file, std::span<const float> values,
               const std::vector<int>& shape) {
    static_assert(std::endian::native == std::endian::little, "'<f4' below says little-endian");
    std::string dimensions;
    for (const int n : shape) dimensions += fmt::format("{}, ", n);
    std::string header =
        fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", dimensions);
    // Magic, version, header length, header: padded with spaces so that the data start at a multiple of 64
    // bytes.
    constexpr std::size_t kBefore = 10;
    header.append(63 - (kBefore + header.size()) % 64, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 0xff);
    bytes += static_cast<char>(header.size() >> 8);
    bytes += header;
    const std::size_t start = bytes.size();
    bytes.resize(start + values.size_bytes());
    std::memcpy(bytes.data() + start, values.data(), values.size_bytes());
    replace_text_file(file, bytes);
}

}  // namespace eddy
