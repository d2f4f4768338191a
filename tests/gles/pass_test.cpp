#include "gles/pass.h"

#include <fmt/format.h>

#include "gles/field.h"
#include "gles/grid_io.h"
#include "gles/shader_source.h"
#include "tests/gles/gl_fixture.h"
#include "tests/gles/refusal.h"

namespace eddy::gles {
namespace {

using PassOverTexture = GlTest;

constexpr AtlasLayout kSquare{{8, 8, 1}, 1};

TEST_F(PassOverTexture, ThatDoesNotCompileSaysWhere) {
    // Line 1 of the declarations is the layout of the target.
    const Variant clash{.declarations = "const float kNothing = no_such_thing;\n"};
    const std::string said = refusal([&] { Pass(gpu, "broken", "gles/copy.frag", kSquare, clash); });
    EXPECT_NE(said.find("gles/copy.frag does not compile"), std::string::npos) << said;
    EXPECT_NE(said.find("declarations for gles/copy.frag:2"), std::string::npos) << said;
    EXPECT_NE(said.find("no_such_thing"), std::string::npos) << said;

    const Variant renamed{.defines = {{"result", "1.0"}}};
    const std::string in_file = refusal([&] { Pass(gpu, "broken", "gles/copy.frag", kSquare, renamed); });
    EXPECT_NE(in_file.find("gles/copy.frag:8"), std::string::npos) << in_file;
}

TEST_F(PassOverTexture, WithAUniformNeverGivenNamesIt) {
    Field<Cells> u(gpu, {8, 8, 1}, Format::RGBA32F);
    Pass drive(gpu, "drive", "gles/fluid/drive.frag", u.layout());
    const std::string said = refusal([&] {
        drive.draw({}, {{"ball", glm::vec4(4.0f, 4.0f, 0.5f, 2.0f)}}, {&u.texture()});
    });
    EXPECT_NE(said.find("gles/fluid/drive.frag"), std::string::npos) << said;
    EXPECT_NE(said.find("'ball_velocity'"), std::string::npos) << said;
}

TEST_F(PassOverTexture, WithASamplerNeverGivenNamesIt) {
    Field<Cells> u(gpu, {8, 8, 1}, Format::RGBA32F);
    Pass copy(gpu, "copy", "gles/copy.frag", u.layout());
    const std::string said = refusal([&] { copy.draw({}, {}, {&u.texture()}); });
    EXPECT_NE(said.find("'field'"), std::string::npos) << said;
}

TEST_F(PassOverTexture, DrawsItsBoxesAndNothingElse) {
    const glm::ivec3 n(9, 7, 13);
    Field<Cells> ones(gpu, n, Format::RGBA32F), out(gpu, n, Format::RGBA32F);
    const AtlasLayout layout = out.layout();
    const std::size_t count = static_cast<std::size_t>(n.x * n.y * n.z);
    ones.texture().upload(&pack_vectors(std::vector<glm::vec3>(count, glm::vec3(1.0f)), layout)[0].x);
    clear(out.texture());
    // One box inside, one that crosses the border, one outside, one empty.
    const std::vector<Box> boxes{{{2, 1, 3}, {5, 6, 11}},
                                 {{7, 5, 12}, {20, 20, 20}},
                                 {{30, 0, 0}, {31, 1, 1}},
                                 {{3, 3, 3}, {3, 4, 4}}};
    Pass copy(gpu, "copy", "gles/copy.frag", layout);
    std::vector<PassRecord> records;
    gpu.record(&records);
    copy.draw({{"field", &ones.texture()}}, {}, {&out.texture()}, Region(boxes));
    gpu.record(nullptr);

    std::int64_t inside = 0;
    std::size_t i = 0;
    const std::vector<float> got = unpack_scalars(out.texture().download(), layout);
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x, ++i) {
                const glm::ivec3 c(x, y, z);
                bool in = false;
                for (const Box& box : boxes) in = in || !Box{c, c + 1}.intersect(box).empty();
                ASSERT_EQ(got[i], in ? 1.0f : 0.0f) << x << "," << y << "," << z;
                inside += in;
            }
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0].draws, 2);
    EXPECT_EQ(records[0].texels, inside);
    EXPECT_EQ(records[0].bytes, 16 * inside);
    EXPECT_EQ(records[0].fetches, inside * declared_fetches("gles/copy.frag"));
    EXPECT_EQ(records[0].inputs, std::vector<std::string>{"field"});
}

TEST_F(PassOverTexture, IsRecordedUnderTheInnermostStage) {
    Field<Cells> a(gpu, {8, 8, 1}, Format::RGBA32F), b(gpu, {8, 8, 1}, Format::RGBA32F);
    clear(a.texture());
    Pass copy(gpu, "copy", "gles/copy.frag", a.layout());
    const auto draw = [&] { copy.draw({{"field", &a.texture()}}, {}, {&b.texture()}); };
    std::vector<PassRecord> records;
    std::vector<std::string> heard;
    gpu.record(&records);
    gpu.watch_stages([&](std::string_view stage, bool begins) {
        heard.push_back(fmt::format("{}{}", begins ? '+' : '-', stage));
    });
    {
        const Gpu::Stage outer(gpu, "outer");
        draw();
        {
            const Gpu::Stage inner(gpu, "inner");
            draw();
        }
        draw();
    }
    gpu.watch_stages({});
    gpu.record(nullptr);
    draw();
    ASSERT_EQ(records.size(), 3u);
    EXPECT_EQ(records[0].stage + " " + records[1].stage + " " + records[2].stage, "outer inner outer");
    EXPECT_EQ(heard, (std::vector<std::string>{"+outer", "+inner", "-inner", "-outer"}));
}

}  // namespace
}  // namespace eddy::gles
