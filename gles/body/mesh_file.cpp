#include "gles/body/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>
#include <vector>

namespace eddy::gles {
namespace {

constexpr std::size_t kMostBytes = 512u << 20u;

/// What a file says, cut and cleaned so that it fits in a message.
std::string shown(std::string_view word) {
    std::string text;
    for (const char c : word.substr(0, 24)) text += c >= ' ' && c <= '~' ? c : '?';
    return "'" + text + (word.size() > 24 ? "...'" : "'");
}

/// The words of the next line; false at the end. A line may end in \r\n.
class Lines {
  public:
    explicit Lines(std::string_view text) : rest_(text) {}
    bool next(std::vector<std::string_view>& words) {
        if (rest_.empty()) return false;
        ++number_;
        const std::string_view line = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
        words.clear();
        constexpr std::string_view kBlank = " \t\r\v\f";
        for (std::size_t from = line.find_first_not_of(kBlank); from != std::string_view::npos;) {
            const std::size_t to = std::min(line.size(), line.find_first_of(kBlank, from));
            words.push_back(line.substr(from, to - from));
            from = line.find_first_not_of(kBlank, to);
        }
        return true;
    }
    std::size_t number() const { return number_; }

  private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

template <class Number>
std::optional<Number> parse(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

/// Three numbers after a keyword.
glm::dvec3 place_in(const std::vector<std::string_view>& words, const TriangleSoup& soup, std::size_t line) {
    if (words.size() < 4)
        soup.refuse(line, fmt::format("{} needs three numbers, not {}", shown(words[0]), words.size() - 1));
    glm::dvec3 x;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = words[static_cast<std::size_t>(axis) + 1];
        const std::optional<double> value = parse<double>(word);
        if (!value) soup.refuse(line, fmt::format("{} is not a number", shown(word)));
        x[axis] = *value;
    }
    return x;
}

std::string lower_case(std::string_view word) {
    std::string text(word);
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

TriangleSoup text_stl(std::string_view text, const std::string& name) {
    TriangleSoup soup{name, true, {}, {}};
    Lines lines(text);
    std::vector<std::string_view> words;
    std::vector<glm::dvec3> corners;
    bool in_solid = false, in_facet = false;
    while (lines.next(words)) {
        if (words.empty()) continue;
        const std::size_t line = lines.number();
        const std::string key = lower_case(words[0]);
        if (key == "solid") {
            in_solid = true;
        } else if (key == "endsolid") {
            in_solid = false;
        } else if (key == "facet") {
            if (in_facet) soup.refuse(line, "a facet begins inside another: 'endfacet' is missing");
            in_facet = true;
            corners.clear();
        } else if (key == "vertex") {
            if (!in_facet) soup.refuse(line, "a vertex outside a facet: 'facet' is missing");
            corners.push_back(place_in(words, soup, line));
        } else if (key == "endfacet") {
            if (!in_facet || corners.size() != 3)
                soup.refuse(line,
                            fmt::format("the facet that ends here has {} corners, not 3: triangulate the "
                                        "mesh and export it again",
                                        in_facet ? corners.size() : 0));
            in_facet = false;
            soup.add({corners[0], corners[1], corners[2]}, line);
        } else if (key != "outer" && key != "endloop") {
            soup.refuse(line,
                        fmt::format("{} is no word of an STL file: export the mesh again", shown(words[0])));
        }
    }
    if (in_solid || in_facet)
        soup.refuse(lines.number(),
                    "the file ends before 'endsolid': it was cut short; copy or export it again");
    return soup;
}

/// Little-endian: 80 bytes of anything, the number of triangles, then for each twelve floats (normal,
/// corners) and two bytes.
constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8u | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

TriangleSoup binary_stl(std::string_view bytes, const std::string& name) {
    TriangleSoup soup{name, false, {}, {}};
    if (bytes.size() < kStlHeader)
        throw MeshError(fmt::format("{}: {} bytes are too few for an STL file: copy or export it again", name,
                                    bytes.size()));
    const std::size_t count = little_endian(bytes, 80), held = (bytes.size() - kStlHeader) / kStlTriangle;
    if (count > held)
        soup.refuse(80,
                    fmt::format("{} triangles are announced, but the file holds {}: it was cut short, or is "
                                "no STL; copy or export it again",
                                count, held));
    for (std::size_t t = 0; t < count; ++t) {
        const std::size_t at = kStlHeader + t * kStlTriangle;
        std::array<glm::dvec3, 3> triangle;
        for (std::size_t k = 0; k < 9; ++k)
            triangle[k / 3][static_cast<int>(k % 3)] =
                static_cast<double>(std::bit_cast<float>(little_endian(bytes, at + 12 + 4 * k)));
        soup.add(triangle, at);
    }
    return soup;
}

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0) throw MeshError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
    if (static_cast<std::uintmax_t>(size) > kMostBytes)
        throw MeshError(fmt::format("{}: {} MB are more than a mesh may have ({} MB): simplify it", path,
                                    size >> 20, kMostBytes >> 20u));
    std::string bytes(static_cast<std::size_t>(size), '\0');
    file.seekg(0);
    if (!file.read(bytes.data(), size))
        throw MeshError(fmt::format("{}: cannot be read: is it a file?", path));
    return bytes;
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, const std::string& name, double scale_m) {
    // Binary files may begin with "solid" too, but text never holds a byte 0.
    const std::size_t start = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    const bool is_text =
        lower_case(bytes.substr(start, 5)) == "solid" && bytes.find('\0') == std::string_view::npos;
    return closed_mesh(is_text ? text_stl(bytes, name) : binary_stl(bytes, name), scale_m);
}

TriangleMesh parse_obj(std::string_view text, const std::string& name, double scale_m) {
    TriangleSoup soup{name, true, {}, {}};
    std::vector<glm::dvec3> vertices;
    Lines lines(text);
    std::vector<std::string_view> words;
    while (lines.next(words)) {
        if (words.empty()) continue;
        const std::size_t line = lines.number();
        if (words[0] == "v") vertices.push_back(place_in(words, soup, line));
        if (words[0] != "f") continue;  // texture, normals, groups, materials: not for us
        std::vector<glm::dvec3> face;
        for (std::size_t i = 1; i < words.size() && words[i].front() != '#'; ++i) {
            // v, v/vt, v//vn or v/vt/vn; from 1, or from -1 backwards.
            const std::optional<long> index = parse<long>(words[i].substr(0, words[i].find('/')));
            const long count = static_cast<long>(vertices.size());
            if (!index) soup.refuse(line, fmt::format("{} is not the number of a vertex", shown(words[i])));
            if (*index == 0 || *index > count || *index < -count)
                soup.refuse(line,
                            fmt::format("vertex {} of {} above this line: numbers run from 1, or from -1 "
                                        "backwards",
                                        *index, count));
            face.push_back(vertices[static_cast<std::size_t>(*index > 0 ? *index - 1 : count + *index)]);
        }
        if (face.size() < 3)
            soup.refuse(line, fmt::format("a face of {} vertices: it needs three", face.size()));
        for (std::size_t i = 2; i < face.size(); ++i) soup.add({face[0], face[i - 1], face[i]}, line);
    }
    return closed_mesh(std::move(soup), scale_m);
}

TriangleMesh read_mesh(const std::string& path, double scale_m) {
    const std::size_t dot = path.rfind('.');
    const std::string ending = dot == std::string::npos ? "" : lower_case(path.substr(dot));
    if (ending != ".stl" && ending != ".obj")
        throw MeshError(
            fmt::format("{}: a mesh is a file that ends in .stl or .obj: export it as one", path));
    const std::string bytes = read_file(path);
    return ending == ".stl" ? parse_stl(bytes, path, scale_m) : parse_obj(bytes, path, scale_m);
}

}  // namespace eddy::gles
