#include "gles/shader_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "cmake/embedded.h"
#include "tests/gles/refusal.h"

namespace eddy {
extern const std::span<const EmbeddedFile> kShaders;
}

namespace eddy::gles {
namespace {

bool holds(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

TEST(ShaderSource, NumbersItsFilesInTheOrderInWhichTheyComeIn) {
    const ShaderSource source =
        load_shader("gles/body/fractions.frag", "#define SWITCH\n", "const int kGiven = 1;\n");
    EXPECT_EQ(source.files,
              (std::vector<std::string>{"gles/atlas.glsl", "declarations for gles/body/fractions.frag",
                                        "gles/body/fractions.frag", "gles/body/fraction.glsl"}));
    EXPECT_EQ(source.text.rfind("#version 300 es\n", 0), 0u);
    const std::size_t at_switch = source.text.find("#define SWITCH"),
                      at_atlas = source.text.find("struct Layout"), at_given = source.text.find("kGiven"),
                      at_main = source.text.find("void main");
    EXPECT_TRUE(at_switch < at_atlas && at_atlas < at_given && at_given < at_main);
}

TEST(ShaderSource, KeepsTheLineNumbersOfEveryFile) {
    const ShaderSource source = load_shader("gles/body/fractions.frag", "", "");
    std::vector<std::string> seen_main;
    std::size_t number = 0, begin = 0;
    int line = 0;
    while (begin < source.text.size()) {
        const std::size_t end = source.text.find('\n', begin);
        const std::string text = source.text.substr(begin, end - begin);
        begin = end + 1;
        if (std::sscanf(text.c_str(), "#line %d %zu", &line, &number) == 2) continue;
        if (text == "void main() {") {
            // Where the file itself has it.
            std::string_view file;
            for (const EmbeddedFile& f : kShaders)
                if (f.name == source.files.at(number)) file = f.text;
            const std::string_view before = file.substr(0, file.find("void main() {"));
            EXPECT_EQ(line % 100'000, 1 + std::count(before.begin(), before.end(), '\n'))
                << source.files.at(number);
            seen_main.push_back(source.files.at(number));
        }
        ++line;
    }
    EXPECT_EQ(seen_main, std::vector<std::string>{"gles/body/fractions.frag"});
}

TEST(ShaderSource, ThatIsNotInTheBinaryIsNamed) {
    const std::string said = refusal([] { load_shader("gles/fluid/advekt.frag", "", ""); });
    EXPECT_TRUE(holds(said, "gles/fluid/advekt.frag") && holds(said, "gles/CMakeLists.txt")) << said;
}

TEST(ShaderSource, WithAMissingIncludeIsNamedWithFileAndLine) {
    const EmbeddedFile broken{"gles/fluid/broken.frag", "// a shader\n\n#include \"nowhere.glsl\"\n"};
    const std::string said = refusal([&] { expand_shader(broken, "", ""); });
    EXPECT_TRUE(holds(said, "gles/fluid/broken.frag:3:") && holds(said, "nowhere.glsl")) << said;
    const EmbeddedFile unquoted{"gles/fluid/broken.frag", "#include nowhere\n"};
    EXPECT_TRUE(holds(refusal([&] { expand_shader(unquoted, "", ""); }), "gles/fluid/broken.frag:1:"));
}

TEST(ShaderLog, OfEachDriverIsTurnedIntoPathsAndLines) {
    ShaderSource source;
    source.files = {"gles/atlas.glsl", "gles/body/fractions.frag", "gles/body/fraction.glsl"};
    const std::pair<std::string, std::string> logs[] = {
        // Mesa
        {"1:12(5): error: `x' undeclared", "gles/body/fractions.frag:12(5): error: `x' undeclared"},
        {"0:3(1): warning: a\n2:7(1): error: b\n",
         "gles/atlas.glsl:3(1): warning: a\ngles/body/fraction.glsl:7(1): error: b\n"},
        // NVIDIA
        {"1(12) : error C0000: syntax error", "gles/body/fractions.frag:12 : error C0000: syntax error"},
        // ANGLE, Mali
        {"ERROR: 2:7: 'y' : undeclared identifier",
         "ERROR: gles/body/fraction.glsl:7: 'y' : undeclared identifier"},
        {"WARNING: 0:3: old\nERROR: 1:4: new",
         "WARNING: gles/atlas.glsl:3: old\nERROR: gles/body/fractions.frag:4: new"},
        // Mesa again, which forgets the file's number but not the line's
        {"0:200007(3): error: `z' undeclared", "gles/body/fraction.glsl:7(3): error: `z' undeclared"},
        // Something else is left as it is.
        {"error: too many instructions", "error: too many instructions"},
        {"9:12(5): error: no such file", "9:12(5): error: no such file"},
    };
    for (const auto& [log, located] : logs) EXPECT_EQ(source.locate(log), located);
}

TEST(EmbeddedShader, DeclaresTheFetchesOfEachOfItsVariants) {
    const auto smooth = [](const std::vector<std::string>& defined) {
        return declared_fetches("gles/fluid/smooth.frag", defined);
    };
    EXPECT_EQ(smooth({}), 8) << "seven of phi, one of b";
    EXPECT_EQ(smooth({"CELLS"}), 8) << "a switch the line does not name changes nothing";
    EXPECT_EQ(smooth({"CUT"}), 14) << "and six fractions";
    EXPECT_EQ(smooth({"FROM_ZERO"}), 1);
    EXPECT_EQ(smooth({"FROM_ZERO", "CUT"}), 7);
}

TEST(EmbeddedShader, ShowsItsContractBeforeItsCode) {
    int shaders = 0;
    for (const EmbeddedFile& file : kShaders) {
        if (!file.name.ends_with(".frag")) continue;
        ++shaders;
        const std::string_view header = file.text.substr(0, file.text.find("void main"));
        const std::string base(file.name.substr(file.name.rfind('/') + 1));
        EXPECT_EQ(header.rfind("// " + base, 0), 0u) << file.name << " does not begin with its name";
        for (const std::string_view line : {"\n// reads   ", "\n// writes  ", "\n// fetches "})
            EXPECT_TRUE(holds(header, line)) << file.name << " has no line" << line;
        EXPECT_GE(declared_fetches(file.name), 0) << file.name;
        EXPECT_TRUE(declared_fetches(file.name) > 0 || !holds(header, "uniform sampler2D"))
            << file.name << " reads textures, yet claims no fetches";
    }
    EXPECT_GT(shaders, 20);
}

}  // namespace
}  // namespace eddy::gles
