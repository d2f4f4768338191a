#pragma once
#include <algorithm>
#include <cmath>
#include <functional>

#include "gles/fluid/fluid.h"
#include "gles/grid_io.h"
#include "gles/render/renderer.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {

/// Smoke that stays as it is: density(x) at the cell centres x [cells]; none where the set-up has no smoke.
class StillSmoke final : public Fluid {
  public:
    using Density = std::function<float(glm::vec3)>;
    StillSmoke(Gpu& gpu, const FluidSetup& setup, const Density& density) : Fluid(setup) {
        if (!setup.smoke) return;
        smoke_.emplace(gpu, setup.cells, Format::R32F);
        const AtlasLayout layout = smoke_->layout();
        std::vector<float> texels(static_cast<std::size_t>(layout.texels().x * layout.texels().y));
        for (int k = 0; k < setup.cells.z; ++k)
            for (int j = 0; j < setup.cells.y; ++j)
                for (int i = 0; i < setup.cells.x; ++i) {
                    const glm::ivec2 t = layout.texel({i, j, k});
                    texels[static_cast<std::size_t>(t.y * layout.texels().x + t.x)] =
                        density(glm::vec3(i, j, k) + 0.5f);
                }
        smoke_->texture().upload(texels.data());
    }
    long steps() const override { return 0; }
    const Field<Cells>* smoke() const override { return smoke_ ? &*smoke_ : nullptr; }
    std::vector<glm::vec3> velocity() const override { return {}; }
    std::vector<float> pressure() const override { return {}; }
    void set_velocity(const std::vector<glm::vec3>&) override {}

  private:
    void move_on(double, const std::vector<BodyState>&, bool) override {}
    std::optional<StepResult> take_result(bool) override { return {}; }
    void start_over() override {}
    FluidState state() const override { return {.setup = setup_, .bodies = bodies_}; }
    void resume(const FluidState&) override {}
    std::optional<Field<Cells>> smoke_;
};

/// A tank of 24 x 20 x 22 cells of 5 mm, so that no axis can stand in for another.
inline FluidSetup tank(bool smoke, bool body) {
    FluidSetup setup;
    setup.cells = {24, 20, 22};
    setup.cell_m = 0.005;
    if (smoke) setup.smoke = SmokeSetup{};
    if (body) setup.bodies.push_back({Sphere{0.015}});
    return setup;
}

inline BodyState ball_at(const glm::dvec3& centre_cells) {
    return {.centre_m = 0.005 * centre_cells};
}

inline const StillSmoke::Density kNone = [](glm::vec3) { return 0.0f; };
inline const StillSmoke::Density kUniform = [](glm::vec3) { return 1.0f; };

/// A round cloud with soft edge, density 1 in the middle.
inline StillSmoke::Density cloud(const glm::vec3& centre, float radius) {
    return [=](glm::vec3 x) { return std::max(0.0f, 1.0f - glm::distance(x, centre) / radius); };
}

/// A picture on the CPU; (0, 0) at the top left.
struct Picture {
    int width, height;
    std::vector<std::uint8_t> rgb;

    glm::dvec3 pixel(int x, int y) const {
        const std::uint8_t* p = &rgb[3 * static_cast<std::size_t>(y * width + x)];
        return {p[0], p[1], p[2]};
    }
};

/// Draws once. `density` matters only if the set-up has smoke.
inline Picture take_picture(Gpu& gpu, const FluidSetup& fluid, const RenderSetup& render,
                            const StillSmoke::Density& density, const std::vector<BodyState>& bodies) {
    const StillSmoke still(gpu, fluid, density);
    Renderer renderer(gpu, fluid, render);
    renderer.draw(still, bodies);
    return {render.width_px, render.height_px, renderer.rgb()};
}

/// Largest and mean difference between two pictures of the same size, in steps of 8 bits.
struct Difference {
    double largest = 0.0, mean = 0.0;
};
inline Difference difference(const Picture& a, const Picture& b) {
    Difference d;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double step = std::abs(static_cast<double>(a.rgb[i]) - b.rgb[i]);
        d.largest = std::max(d.largest, step);
        d.mean += step / static_cast<double>(a.rgb.size());
    }
    return d;
}

}  // namespace eddy::gles
