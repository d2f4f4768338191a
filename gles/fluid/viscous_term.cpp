#include "gles/fluid/viscous_term.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gles/fluid/pressure.h"

namespace eddy::gles {
namespace {

constexpr float kLeastLambda = 0.125f;  // below it two sweeps leave nothing for a coarser grid to do
constexpr int kCoarsestSweeps = 4;

}  // namespace

float ViscousTerm::Equation::on(std::size_t level) const {
    return lambda * std::exp2(-2.0f * static_cast<float>(level));
}

ViscousTerm::ViscousTerm(Gpu& gpu, const FluidSetup& setup, const Walls& walls) : gpu_(&gpu), setup_(&setup) {
    const std::vector<glm::ivec3> grids = multigrid_levels(setup.cells);
    for (const glm::ivec3& n : grids) levels_.push_back({n, {}, {}, {}, {}, {}, {}});
    if (!setup.bodies.empty()) grip_.emplace(gpu, grids, setup.bodies);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const AtlasLayout here = Faces::layout(level.cells);
        level.smooth.emplace(make(gpu, "viscous smooth", "gles/fluid/viscous_smooth.frag", l, {}, walls));
        if (l == 0)
            level.guess_smooth.emplace(make(gpu, "viscous smooth guess", "gles/fluid/viscous_smooth.frag", l,
                                            {.defines = {{"GUESS", ""}}}, walls));
        if (l > 0)
            level.first_smooth.emplace(make(gpu, "viscous smooth from zero", "gles/fluid/viscous_smooth.frag",
                                            l, {.defines = {{"FROM_ZERO", ""}}}, walls));
        if (l > 0)
            level.restrict_to.emplace(
                gpu, fmt::format("viscous restrict {}", l), "gles/fluid/viscous_restrict.frag", here,
                Variant{.layouts = {{"FACES", here}, {"FINE", Faces::layout(levels_[l - 1].cells)}}});
        if (l + 1 == levels_.size()) break;
        level.residual.emplace(
            make(gpu, "viscous residual", "gles/fluid/viscous_residual.frag", l, {}, walls));
        level.prolong.emplace(make(gpu, "viscous prolong", "gles/fluid/viscous_prolong.frag", l,
                                   {.layouts = {{"COARSE", Faces::layout(grids[l + 1])}}}, walls));
    }
}

ViscousTerm::Split ViscousTerm::make(Gpu& gpu, const char* name, const char* shader, std::size_t l,
                                     Variant variant, const Walls& walls) const {
    const glm::ivec3 n = levels_[l].cells;
    variant.layouts.emplace_back("FACES", Faces::layout(n));
    variant.defines.emplace_back("CELLS", glsl(n));
    if (l > 0) variant.defines.emplace_back("CORRECTION", "");
    const glm::vec3 covered = glm::vec3(setup_->cells) / std::exp2(static_cast<float>(l)) - glm::vec3(n - 1);
    walls.declare(variant, covered);
    glm::vec3 to_wall(1.0f);
    for (int axis = 0; axis < 3; ++axis)
        if (setup_->walls[static_cast<std::size_t>(2 * axis + 1)].kind != WallKind::Open)
            to_wall[axis] = 1.0f / covered[axis];
    if (to_wall != glm::vec3(1.0f))
        variant.defines.emplace_back(
            "TO_WALL", fmt::format("vec3({:.8f}, {:.8f}, {:.8f})", to_wall.x, to_wall.y, to_wall.z));
    Variant cut = variant;
    cut.defines.emplace_back("CUT", "");
    Split split{Pass(gpu, fmt::format("{} {}", name, l), shader, Faces::layout(n), variant), {}};
    if (grip_) split.cut.emplace(gpu, fmt::format("{} {} cut", name, l), shader, Faces::layout(n), cut);
    return split;
}

void ViscousTerm::place(const BodyUniforms& bodies, const std::vector<Box>& boxes,
                        const FaceFractions& fractions) {
    if (grip_) grip_->update(bodies, boxes, fractions);
}

void ViscousTerm::draw(Split& pass, std::size_t l, std::vector<Input> inputs, std::vector<Uniform> uniforms,
                       const Equation& equation, const Texture& out) {
    uniforms.insert(uniforms.end(), equation.uniforms.begin(), equation.uniforms.end());
    uniforms.push_back({"lambda", equation.on(l)});
    pass.plain.draw(inputs, uniforms, {&out});
    if (!pass.cut) return;
    const Grip::Level& grip = grip_->level(l);
    inputs.insert(inputs.end(), {{"shares", &grip.shares.texture()}, {"grips", &grip.grips.texture()}});
    if (l == 0) inputs.push_back({"surface", &grip_->surface().texture()});
    pass.cut->draw(inputs, uniforms, {&out}, Region(grip_->boxes(l)));
}

Field<Faces> ViscousTerm::smooth(std::size_t l, const Field<Faces>* u, std::optional<float> most_m_s,
                                 const Field<Faces>& rhs, float omega, const Equation& equation) {
    Level& level = levels_[l];
    Field<Faces> next(*gpu_, level.cells, Format::RGBA32F);
    Split& sweep = most_m_s ? *level.guess_smooth : u ? *level.smooth : *level.first_smooth;
    std::vector<Uniform> uniforms{{"omega", omega}};
    if (most_m_s) uniforms.push_back({"most", *most_m_s});
    std::vector<Input> inputs{{"rhs", &rhs.texture()}};
    if (u) inputs.push_back({"velocity", &u->texture()});
    draw(sweep, l, inputs, uniforms, equation, next.texture());
    return next;
}

Field<Faces> ViscousTerm::cycle(std::size_t l, const Field<Faces>* guess, std::optional<float> most_m_s,
                                const Field<Faces>& rhs, const Equation& equation) {
    Level& level = levels_[l];
    const bool coarsest = l + 1 == equation.levels;
    const float lambda = equation.on(l);
    // Before and after the coarser grids: what they cannot hold. On the coarsest: everything.
    const std::vector<float> omegas =
        coarsest ? diffusion_weights(kCoarsestSweeps, lambda, 0.1) : diffusion_weights(2, lambda, 1.0 / 3.0);
    Field<Faces> u = smooth(l, guess, most_m_s, rhs, omegas[0], equation);
    for (std::size_t i = 1; i < omegas.size(); ++i) u = smooth(l, &u, std::nullopt, rhs, omegas[i], equation);
    if (coarsest) return u;

    Field<Faces> residual(*gpu_, level.cells, Format::RGBA32F);
    draw(*level.residual, l, {{"velocity", &u.texture()}, {"rhs", &rhs.texture()}}, {}, equation,
         residual.texture());
    Level& coarse = levels_[l + 1];
    Field<Faces> rhs_coarse(*gpu_, coarse.cells, Format::RGBA32F);
    coarse.restrict_to->draw({{"residual", &residual.texture()}}, {}, {&rhs_coarse.texture()});
    const Field<Faces> correction = cycle(l + 1, nullptr, std::nullopt, rhs_coarse, equation);
    Field<Faces> corrected(*gpu_, level.cells, Format::RGBA32F);
    draw(*level.prolong, l, {{"velocity", &u.texture()}, {"correction", &correction.texture()}}, {}, equation,
         corrected.texture());
    u = std::move(corrected);
    for (float omega : omegas) u = smooth(l, &u, std::nullopt, rhs, omega, equation);
    return u;
}

Field<Faces> ViscousTerm::diffuse(const Field<Faces>& guess, float most_m_s, const Field<Faces>& u_star,
                                  double dt_s, int cycles, const Uniform& wall_time) {
    Equation equation{diffusion_number(*setup_, dt_s), 1, {wall_time}};
    while (equation.levels < levels_.size() && equation.on(equation.levels) > kLeastLambda) ++equation.levels;
    Field<Faces> u = cycle(0, &guess, most_m_s, u_star, equation);
    for (int i = 1; i < cycles; ++i) u = cycle(0, &u, std::nullopt, u_star, equation);
    return u;
}

}  // namespace eddy::gles
