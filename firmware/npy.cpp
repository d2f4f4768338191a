#include "firmware/npy.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

#include "firmware/input_error.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

/// What stands behind a key of the header's Python dictionary.
std::string entry(const std::string& header, const std::string& key, const std::string& value) {
    std::smatch m;
    std::regex_search(header, m, std::regex("'" + key + "': *" + value));
    return m.empty() ? "" : m[1].str();
}

std::vector<int> numbers(const std::string& tuple) {
    static const std::regex number(R"(\d{1,9})");
    std::vector<int> all;
    for (std::sregex_iterator m(tuple.begin(), tuple.end(), number), end; m != end; ++m)
        all.push_back(std::stoi(m->str()));
    return all;
}

}  // namespace

NpyArray read_npy(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    const std::string bytes = content.str();
    const auto refuse = [&](const std::string& what) {
        throw InputError(fmt::format("{}: {}", file.string(), what));
    };
    if (!in) refuse("cannot be read");
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(bytes[i])}; };
    if (bytes.size() < 12 || bytes.substr(0, 6) != "\x93NUMPY")
        refuse("is not a NumPy array file: write it with outputs.fields, or with numpy.save()");
    // The header's length has two bytes in version 1 of the format, four in later ones.
    const bool is_long = byte(6) > 1;
    const std::size_t before = is_long ? 12 : 10;
    const std::size_t length = byte(8) + (byte(9) << 8) + (is_long ? (byte(10) << 16) + (byte(11) << 24) : 0);
    if (bytes.size() < before + length) refuse("is damaged: it ends in its header");
    const std::string header = bytes.substr(before, length);
    const std::string type = entry(header, "descr", "'([^']*)'");
    if (type != "<f4")
        refuse(fmt::format("holds {}, not 32-bit floats: numpy.save(file, array.astype('<f4')) makes them so",
                           type.empty() ? "no plain array" : type));
    if (entry(header, "fortran_order", "(True|False)") != "False")
        refuse("is in Fortran order: numpy.save(file, numpy.ascontiguousarray(array)) puts it right");

    NpyArray array;
    array.shape = numbers(entry(header, "shape", R"(\(([^)]*)\))"));
    double values = 1.0;
    for (const int n : array.shape) values *= n;
    const std::size_t held = (bytes.size() - before - length) / sizeof(float);
    if (values != static_cast<double>(held))
        refuse(fmt::format("is damaged: its header speaks of {} values, but it holds {}", values, held));
    array.values.resize(held);
    if (held > 0) std::memcpy(array.values.data(), bytes.data() + before + length, held * sizeof(float));
    return array;
}

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
