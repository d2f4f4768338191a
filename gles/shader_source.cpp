#include "gles/shader_source.h"

#include <algorithm>

#include <fmt/format.h>

#include <regex>
#include <set>
#include <span>
#include <sstream>

#include "cmake/embedded.h"
#include "gles/context.h"

namespace eddy {
extern const std::span<const EmbeddedFile> kShaders;
}

namespace eddy::gles {
namespace {

/// Line n of file number f is numbered f * kLines + n as well as given f. Mesa (22.3) keeps the file's number
/// for syntax errors only and says 0 for all others; the line's number it always keeps.
constexpr std::size_t kLines = 100'000;

std::string line_mark(std::size_t file, std::size_t line) {
    return fmt::format("#line {} {}\n", file * kLines + line, file);
}

const EmbeddedFile* find(std::string_view path) {
    for (const EmbeddedFile& file : kShaders)
        if (file.name == path) return &file;
    return nullptr;
}

const EmbeddedFile& find_or_throw(std::string_view path) {
    if (const EmbeddedFile* file = find(path)) return *file;
    throw GlError(fmt::format("shader {} is not in this binary; is it listed in gles/CMakeLists.txt?", path));
}

class Expander {
  public:
    explicit Expander(ShaderSource& out) : out_(out) {}

    void expand(const EmbeddedFile& file) {
        const std::size_t number = out_.files.size();
        out_.files.emplace_back(file.name);
        out_.text += line_mark(number, 1);
        std::istringstream lines{std::string(file.text)};
        std::string line;
        for (std::size_t n = 1; std::getline(lines, line); ++n) {
            if (line.rfind("#include", 0) != 0) {
                out_.text += line + '\n';
                continue;
            }
            const EmbeddedFile& wanted = resolve(file.name, line, n);
            if (included_.insert(wanted.name).second) expand(wanted);
            out_.text += line_mark(number, n + 1);
        }
    }

  private:
    static const EmbeddedFile& resolve(std::string_view from, const std::string& line, std::size_t n) {
        const std::size_t open = line.find('"'), close = line.rfind('"');
        if (open == close) throw GlError(fmt::format("{}:{}: #include needs a \"file\"", from, n));
        const std::string name = line.substr(open + 1, close - open - 1);
        const std::string folder(from.substr(0, from.rfind('/') + 1));
        if (const EmbeddedFile* beside = find(folder + name)) return *beside;
        if (const EmbeddedFile* common = find("gles/" + name)) return *common;
        throw GlError(fmt::format("{}:{}: no shader file {} or gles/{}; is it listed in gles/CMakeLists.txt?",
                                  from, n, folder + name, name));
    }

    ShaderSource& out_;
    std::set<std::string_view> included_;
};

}  // namespace

ShaderSource load_shader(std::string_view path, std::string_view switches, std::string_view declarations) {
    return expand_shader(find_or_throw(path), switches, declarations);
}

ShaderSource expand_shader(const EmbeddedFile& file, std::string_view switches,
                           std::string_view declarations) {
    ShaderSource source;
    source.text =
        "#version 300 es\n"
        "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
    source.text += switches;
    Expander expander(source);
    expander.expand(find_or_throw("gles/atlas.glsl"));
    source.text += line_mark(source.files.size(), 1);
    source.text += declarations;
    source.files.push_back(fmt::format("declarations for {}", file.name));
    expander.expand(file);
    return source;
}

std::string ShaderSource::locate(std::string_view log) const {
    static const std::regex number(R"((^|\n)(ERROR: |WARNING: )?(\d+)(:|\()(\d+))");
    std::string rest(log), result;
    std::smatch m;
    while (std::regex_search(rest, m, number)) {
        const std::size_t line = std::stoul(m[5]);
        const std::size_t file = line >= kLines ? line / kLines : std::stoul(m[3]);
        const std::string name = file < files.size() ? files[file] : m[3].str();
        result += fmt::format("{}{}{}{}:{}", m.prefix().str(), m[1].str(), m[2].str(), name, line % kLines);
        const bool in_parentheses = m[4] == "(";
        rest = m.suffix().str();
        if (in_parentheses && !rest.empty() && rest.front() == ')') rest.erase(0, 1);
    }
    return result + rest;
}

int declared_fetches(std::string_view path, const std::vector<std::string>& defined) {
    static const std::regex line(R"(\n// fetches (\d+)((, \w+(\+\w+)* \d+)*))"),
        variant(R"((\w+(\+\w+)*) (\d+))"), switch_name(R"(\w+)");
    const std::string text(find_or_throw(path).text);
    std::smatch m;
    if (!std::regex_search(text, m, line))
        throw GlError(
            fmt::format("{}: its header has no line '// fetches N', the texture fetches per texel", path));
    int fetches = std::stoi(m[1]);
    const std::string variants = m[2];
    for (std::sregex_iterator v(variants.begin(), variants.end(), variant), end; v != end; ++v) {
        const std::string names = (*v)[1];
        const bool applies =
            std::all_of(std::sregex_iterator(names.begin(), names.end(), switch_name), std::sregex_iterator(),
                        [&](const std::smatch& name) {
                            return std::count(defined.begin(), defined.end(), name.str()) > 0;
                        });
        if (applies) fetches = std::stoi((*v)[3]);
    }
    return fetches;
}

}  // namespace eddy::gles
