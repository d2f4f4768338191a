#include <EGL/egl.h>

#include <GLES3/gl3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>

#include "gles/render/window.h"
#include "tests/gles/render/rig.h"

namespace eddy::gles {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

const RenderSetup kSmall{.width_px = 160, .height_px = 120};

/// Light that is displayed as `value` of 255 at exposure 1: the inverse of displayed() in picture.frag, by
/// bisection.
double light_of(double value) {
    double low = 0.0, high = 20.0;
    for (int i = 0; i < 60; ++i) {
        const double c = 0.5 * (low + high);
        const double film = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
        (std::pow(film, 1.0 / 2.2) < value / 255.0 ? low : high) = c;
    }
    return low;
}

TEST(Picture, OfUniformSmokeLetsTheRoomThroughExponentially) {
    Gpu& gpu = shared_gpu();
    // Level with the tank, the middle of the picture sees the room straight through its whole depth of 22
    // cells.
    RenderSetup render{.width_px = 65, .height_px = 65, .azimuth_deg = 0.0, .elevation_deg = 0.0};
    render.smoke_colour = glm::dvec3(0.0);
    render.background_colour = glm::dvec3(1.0);
    const double room = light_of(take_picture(gpu, tank(true, false), render, kNone, {}).pixel(32, 32).x);
    for (double depth : {0.5, 1.0, 2.0}) {
        render.optical_density_1_m = depth / (22 * 0.005);
        const Picture dimmed = take_picture(gpu, tank(true, false), render, kUniform, {});
        // Half a step of 255, and the dither's other half, near where the film curve is flattest: 3 %.
        EXPECT_NEAR(light_of(dimmed.pixel(32, 32).x) / (room * std::exp(-depth)), 1.0, 0.03);
    }
}

TEST(Picture, OfZeroSmokeIsThatOfASceneWithoutSmoke) {
    Gpu& gpu = shared_gpu();
    const std::vector<BodyState> ball{ball_at({14.0, 9.0, 12.0})};
    const Picture with = take_picture(gpu, tank(true, true), kSmall, kNone, ball);
    const Picture without = take_picture(gpu, tank(false, true), kSmall, kNone, ball);
    EXPECT_LE(difference(with, without).largest, 1.0);
}

TEST(Picture, WithoutSmokeAsksForNoSmoke) {
    Gpu& gpu = shared_gpu();
    std::vector<PassRecord> records;
    gpu.record(&records);
    take_picture(gpu, tank(false, true), kSmall, kNone, {ball_at({14.0, 9.0, 12.0})});
    gpu.record(nullptr);
    std::vector<std::string> passes;
    for (const PassRecord& record : records) {
        passes.push_back(record.stage + ": " + record.pass);
        EXPECT_THAT(record.inputs, Not(Contains("smoke")));
    }
    EXPECT_THAT(passes, ElementsAre("light: light", "render: picture"));
}

TEST(Picture, BodyHidesWhatIsBehindItAndIsVeiledByWhatIsBeforeIt) {
    Gpu& gpu = shared_gpu();
    RenderSetup render{.width_px = 121, .height_px = 121, .azimuth_deg = 0.0, .elevation_deg = 0.0};
    render.to_key = {0.0, 0.3, 1.0};
    render.optical_density_1_m = 300.0;
    const std::vector<BodyState> ball{ball_at({12.0, 10.0, 11.0})};
    const Picture alone = take_picture(gpu, tank(true, true), render, kNone, ball);
    const Picture before =
        take_picture(gpu, tank(true, true), render, cloud({12.0f, 10.0f, 18.0f}, 4.0f), ball);
    const Picture behind =
        take_picture(gpu, tank(true, true), render, cloud({12.0f, 10.0f, 4.0f}, 8.0f), ball);
    EXPECT_LE(glm::distance(behind.pixel(60, 60), alone.pixel(60, 60)), 2.0);
    EXPECT_GT(glm::distance(before.pixel(60, 60), alone.pixel(60, 60)), 30.0);
    EXPECT_GT(glm::distance(behind.pixel(60, 48), alone.pixel(60, 48)), 30.0);  // 0.8 cells past its rim
}

TEST(Picture, ShowsACloudWhereTheCameraSeesIt) {
    Gpu& gpu = shared_gpu();
    const glm::dvec3 cloud_at(8.0, 12.0, 15.0), cells(24.0, 20.0, 22.0);
    for (double azimuth : {0.0, 90.0}) {
        RenderSetup render = kSmall;
        render.azimuth_deg = azimuth;
        render.optical_density_1_m = 5.0;  // thin: no side of it is in shadow
        const Picture empty = take_picture(gpu, tank(true, false), render, kNone, {});
        const Picture smoke =
            take_picture(gpu, tank(true, false), render, cloud(glm::vec3(cloud_at), 4.0f), {});
        double total = 0.0;
        glm::dvec2 centre(0.0);
        for (int y = 0; y < smoke.height; ++y)
            for (int x = 0; x < smoke.width; ++x) {
                const double more = std::max(0.0, smoke.pixel(x, y).y - empty.pixel(x, y).y - 2.0);
                total += more;
                centre += more * glm::dvec2(x + 0.5, y + 0.5);
            }
        ASSERT_GT(total, 500.0);
        const Camera camera{render.azimuth_deg, render.elevation_deg, render.distance};
        const glm::dvec3 seen = glm::inverse(camera.rays(160.0 / 120.0)) * (cloud_at - camera.eye(cells));
        EXPECT_NEAR(centre.x / total, 80.0 * (1.0 + seen.x / seen.z), 1.0);  // a cell is 3 pixels
        EXPECT_NEAR(centre.y / total, 60.0 * (1.0 - seen.y / seen.z), 1.0);
    }
}

TEST(Picture, IsTheSameWithAndWithoutHardwareFiltering) {
    Gpu& gpu = shared_gpu();
    if (!gpu.filters_float()) GTEST_SKIP() << "skipped: this driver lacks OES_texture_float_linear";
    const std::vector<BodyState> ball{ball_at({14.0, 9.0, 12.0})};
    const auto smoke = cloud({10.0f, 11.0f, 10.0f}, 8.0f);
    const Picture hardware = take_picture(gpu, tank(true, true), kSmall, smoke, ball);
    gpu.set_filters_float(false);
    const Picture fetched = take_picture(gpu, tank(true, true), kSmall, smoke, ball);
    gpu.set_filters_float(true);
    // Hardware may place a sample with 8 bits between two texels.
    EXPECT_LE(difference(hardware, fetched).largest, 3.0);
    EXPECT_LE(difference(hardware, fetched).mean, 0.2);
}

TEST(Picture, OfAMirroredSceneIsMirrored) {
    Gpu& gpu = shared_gpu();
    RenderSetup render = kSmall;
    render.azimuth_deg = 0.0;
    render.steps = 256;
    const Picture picture = take_picture(gpu, tank(true, true), render, cloud({8.0f, 11.0f, 10.0f}, 7.0f),
                                         {ball_at({15.0, 9.0, 12.0})});
    render.to_key.x = -render.to_key.x;
    Picture mirrored = take_picture(gpu, tank(true, true), render, cloud({16.0f, 11.0f, 10.0f}, 7.0f),
                                    {ball_at({9.0, 9.0, 12.0})});
    EXPECT_GT(difference(picture, mirrored).largest, 50.0);
    const Picture seen = mirrored;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x)
            for (int c = 0; c < 3; ++c)
                mirrored.rgb[static_cast<std::size_t>(3 * (y * seen.width + x) + c)] =
                    static_cast<std::uint8_t>(seen.pixel(seen.width - 1 - x, y)[c]);
    // The noise that breaks up bands is not mirrored.
    EXPECT_LE(difference(picture, mirrored).mean, 0.6);
    EXPECT_LE(difference(picture, mirrored).largest, 8.0);
}

TEST(Picture, AtHalfResolutionIsNearlyThatAtFull) {
    Gpu& gpu = shared_gpu();
    RenderSetup render = kSmall;
    const std::vector<BodyState> ball{ball_at({14.0, 9.0, 12.0})};
    const auto smoke = cloud({12.0f, 10.0f, 14.0f}, 8.0f);
    const Picture half = take_picture(gpu, tank(true, true), render, smoke, ball);
    render.half_resolution = false;
    const Picture full = take_picture(gpu, tank(true, true), render, smoke, ball);
    EXPECT_LE(difference(half, full).mean, 1.0);
    EXPECT_LE(difference(half, full).largest, 16.0);  // no halo around the ball
}

TEST(Picture, StartsWithItsTopRow) {
    Gpu& gpu = shared_gpu();
    const Picture picture =
        take_picture(gpu, tank(false, true), kSmall, kNone, {ball_at({12.0, 16.0, 11.0})});
    double redness = 0.0, moment = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec3 p = picture.pixel(x, y);
            const double red = std::max(0.0, p.x - p.z - 40.0);  // only the ball is so red
            redness += red;
            moment += red * y;
        }
    ASSERT_GT(redness, 0.0);
    EXPECT_LT(moment / redness, 0.5 * picture.height);
}

TEST(Picture, OfARunningJetIsNeitherFlatNorBlownOut) {
    Gpu& gpu = shared_gpu();
    FluidSetup setup = tank(true, true);
    setup.sources.push_back({.centre_m = {0.02, 0.08, 0.055},
                             .radius_m = 0.012,
                             .velocity_m_s = glm::dvec3(0.3, -0.3, 0.0),
                             .smoke_per_s = 20.0});
    const auto fluid = make_fluid(gpu, setup);
    const std::vector<BodyState> ball{ball_at({13.0, 9.0, 12.0})};
    for (int i = 0; i < 20; ++i) fluid->step(0.01, ball, false);
    Renderer renderer(gpu, setup, kSmall);
    renderer.draw(*fluid, ball);
    for (const glm::vec4& t : renderer.light().texture().download()) ASSERT_TRUE(t.x >= 0.0f && t.x <= 1.0f);
    const std::vector<std::uint8_t> rgb = renderer.rgb();
    EXPECT_GT(std::count_if(rgb.begin(), rgb.end(), [](int v) { return v > 120; }), 300);
    EXPECT_EQ(std::count(rgb.begin(), rgb.end(), 255), 0);
    EXPECT_GT(std::count_if(rgb.begin(), rgb.end(), [](int v) { return v < 60; }), 10000);
}

TEST(Picture, IsShownAsLargeAsFitsInTheMiddleOfTheWindow) {
    Gpu& gpu = shared_gpu();
    // A window stands in for the screen: an EGL surface in memory, bound to the same context.
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLContext context = eglGetCurrentContext();
    EGLint id = 0;
    eglQueryContext(display, context, EGL_CONFIG_ID, &id);
    const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    eglChooseConfig(display, wanted, &config, 1, &found);
    const EGLint size[] = {EGL_WIDTH, 400, EGL_HEIGHT, 240, EGL_NONE};
    const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    if (surface == EGL_NO_SURFACE || !eglMakeCurrent(display, surface, surface, context))
        GTEST_SKIP() << "skipped: this driver has no surfaces in memory";

    const FluidSetup setup = tank(false, true);
    const StillSmoke still(gpu, setup, kNone);
    Renderer renderer(gpu, setup, kSmall);
    renderer.draw(still, {ball_at({12.0, 10.0, 11.0})});
    show_in_window(gpu, renderer.picture(), {400, 240});  // the picture, 4 : 3, fills 320 x 240 in the middle
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    std::vector<std::uint8_t> window(4 * 400 * 240);
    glReadPixels(0, 0, 400, 240, GL_RGBA, GL_UNSIGNED_BYTE, window.data());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
    eglDestroySurface(display, surface);

    const Picture picture{160, 120, renderer.rgb()};
    const auto shown = [&](int x, int y_from_top) {
        const std::uint8_t* p = &window[4 * static_cast<std::size_t>((239 - y_from_top) * 400 + x)];
        return glm::dvec3(p[0], p[1], p[2]);
    };
    EXPECT_EQ(shown(20, 120), glm::dvec3(0.0));
    EXPECT_EQ(shown(380, 120), glm::dvec3(0.0));
    EXPECT_LT(glm::distance(shown(200, 120), picture.pixel(80, 60)), 12.0);  // the ball
    EXPECT_LT(glm::distance(shown(200, 230), picture.pixel(80, 115)), 6.0);  // the table
}

}  // namespace
}  // namespace eddy::gles
