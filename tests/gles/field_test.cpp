#include "gles/field.h"

#include <type_traits>

#include "gles/fluid/pressure.h"
#include "gles/fluid/traction.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

// Swapped fields do not compile: no storage turns into another, and passes take the one they mean.
template <class To, class From>
concept Takes = std::is_convertible_v<Field<From>, Field<To>> || std::is_assignable_v < Field<To>
&, Field < From >> || std::is_constructible_v<Field<To>, Field<From>>;
template <class Phi, class B>
concept Solves = requires(Pressure& pressure, Field<Phi> phi, const Field<B>& b,
                          const std::vector<Box>& boxes) {
    pressure.solve(std::move(phi), b, {.cut = boxes});
};
template <class Phi>
concept Pushes = requires(Traction& traction, const Field<Phi>& phi, const FaceFractions& a,
                          const BodyUniforms& u, const std::vector<BodyState>& states,
                          const std::vector<Box>& boxes, const Texture& target) {
    traction.draw(phi, a, u, states, boxes, target, std::nullopt);
};

static_assert(Takes<Cells, Cells> && Takes<Faces4, Faces4>);
static_assert(!Takes<Cells, Faces> && !Takes<Faces, Cells>);
static_assert(!Takes<Cells4, Cells> && !Takes<Cells, Cells4>);
static_assert(!Takes<Faces4, Faces> && !Takes<Faces4, Cells4>);
static_assert(Solves<Cells4, Cells4>);
static_assert(!Solves<Faces, Cells4> && !Solves<Cells4, Cells> && !Solves<Cells4, Faces4>);
static_assert(Pushes<Cells4>);
static_assert(!Pushes<Cells> && !Pushes<Faces>);
// Ping-pong moves; a copy would share a texture without saying so.
static_assert(!std::is_copy_constructible_v<Field<Cells>> && !std::is_copy_assignable_v<Field<Cells>>);

using FieldTest = GlTest;

TEST_F(FieldTest, LeasesATextureOfItsStoragesSize) {
    const glm::ivec3 n(5, 6, 7);
    EXPECT_EQ(Field<Faces4>(gpu, n, Format::RGBA32F).texture().size(), Faces4::layout(n).texels());
    EXPECT_EQ(Field<Cells>(gpu, n, Format::R32F).cells(), n);
    EXPECT_FALSE(Field<Cells>());
}

TEST_F(FieldTest, GivesItsTextureBackWhenAssignedOver) {
    const glm::ivec3 n(5, 6, 7);
    Field<Cells> a(gpu, n, Format::R32F), b(gpu, n, Format::R32F);
    const std::size_t made = gpu.textures().made();
    for (int i = 0; i < 5; ++i) {
        a = std::move(b);
        b = Field<Cells>(gpu, n, Format::R32F);
    }
    EXPECT_EQ(gpu.textures().made(), made);
}

}  // namespace
}  // namespace eddy::gles
