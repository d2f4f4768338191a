#include "gles/fluid/pressure.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

constexpr int kCoarsest = 4;  // cells an axis at which coarsening stops
// Cells around a body or source that are swept once more. Fewer cost less, but the largest residual then sits
// right outside: `eddy bench --grid 64`, fast, cuts max |div u| 498, 504, 561 times with 8, 10, 12, at 2 % more fetches.
constexpr int kRoughReach = 12;

// How much of the coarse grid's correction a cycle proposes with thin bodies. All of it has the wrong sign beside some plates,
// and then no amount of it is of use; at this, what a cycle leaves falls on average to 0.36 - 0.52, at the worst place to 0.92.
constexpr double kThinShare = 0.6;

// The sweeps of one visit smooth what a coarser grid cannot hold: eigenvalues of D^-1 A from 1/3 up to 2.
const std::vector<float> kSmoother = chebyshev_weights(2, 1.0 / 3.0, 2.0);
// On the coarsest grid they must solve: the slowest mode of 4 cells has (1 - cos(pi/4)) / 3 = 0.098; where one end is open,
// (1 - cos(pi/8)) / 3 = 0.025.
const std::vector<float> kSolver = chebyshev_weights(8, 0.08, 2.0),
                         kSolverOpen = chebyshev_weights(16, 0.02, 2.0);

std::string glsl(const std::vector<float>& values) {
    return fmt::format("float[{}]({:.8f})", values.size(), fmt::join(values, ", "));
}

}  // namespace

std::vector<glm::ivec3> multigrid_levels(const glm::ivec3& n) {
    std::vector<glm::ivec3> levels{n};
    while (levels.size() < 2 || std::max({levels.back().x, levels.back().y, levels.back().z}) > kCoarsest)
        levels.push_back((levels.back() + 1) / 2);
    return levels;
}

std::vector<float> chebyshev_weights(int m, double low, double high) {
    // Roots numbered so that each is followed by its counterpart: theta(2i-1), theta(2i) from order m/2 (m a
    // power of 2).
    std::vector<int> order{1};
    while (static_cast<int>(order.size()) < m) {
        const int twice = 2 * static_cast<int>(order.size());
        std::vector<int> next;
        for (int k : order) {
            next.push_back(k);
            next.push_back(twice + 1 - k);
        }
        order = next;
    }
    std::vector<float> weights;
    for (int k : order) {
        const double root =
            std::cos(std::numbers::pi * (2.0 * k - 1.0) / (2.0 * static_cast<double>(order.size())));
        weights.push_back(static_cast<float>(1.0 / (0.5 * (high + low) - 0.5 * (high - low) * root)));
    }
    return weights;
}

std::vector<float> diffusion_weights(int m, float lambda, double low) {
    const double least = 1.0 / (1.0 + 6.0 * static_cast<double>(lambda));
    return chebyshev_weights(m, std::max(low, least), 2.0 - least);
}

Pressure::Pressure(Gpu& gpu, const glm::ivec3& cells, const Fractions* fractions, const Walls& walls,
                   bool from_zero)
    : gpu_(&gpu), fractions_(fractions), solver_(walls.let_through() ? kSolverOpen : kSolver) {
    const std::vector<glm::ivec3> grids = multigrid_levels(cells);
    for (std::size_t l = 0; l < grids.size(); ++l) {
        const glm::ivec3 n = grids[l];
        Level level{n, std::min({n.x, n.y, n.z}) >= kBoxedFrom, {}, {}, {}, {}, {}, {}, {}};
        levels_.push_back(std::move(level));
    }
    if (fractions_) {
        const AtlasLayout finest = Cells4::layout(cells);
        follow_.emplace(gpu, "follow bodies", "gles/fluid/follow.frag", finest,
                        Variant{.defines = {{"CELLS", glsl(cells)}}});
        copy_back_.emplace(gpu, "copy back", "gles/copy.frag", finest);
    }
    if (fractions_ && fractions_->are_thin()) {
        least_residual_.emplace(gpu, cells);
        const AtlasLayout finest = Cells4::layout(cells);
        residual_.emplace(make(gpu, "residual", "gles/fluid/residual.frag", 0, finest, {}, walls));
        keep_.emplace(gpu, "keep pressure", "gles/fluid/keep_pressure.frag", finest);
    }
    for (std::size_t l = 0; l < grids.size(); ++l) {
        Level& level = levels_[l];
        const AtlasLayout here = Cells4::layout(grids[l]);
        if (l + 1 == grids.size()) {
            level.solve.emplace(make(gpu, "solve", "gles/fluid/solve_coarsest.frag", l, here,
                                     {.defines = {{"OMEGA", glsl(solver_)}}}, walls));
            break;
        }
        level.sweep.emplace(make(gpu, "smooth", "gles/fluid/smooth.frag", l, here, {}, walls));
        if (l == 0)
            level.guess_sweep.emplace(make(gpu, "smooth guess", "gles/fluid/smooth.frag", l, here,
                                           {.defines = {{"GUESS", ""}}}, walls));
        if (l > 0 || from_zero || least_residual_)
            level.first_sweep.emplace(make(gpu, "smooth from zero", "gles/fluid/smooth.frag", l, here,
                                           {.defines = {{"FROM_ZERO", ""}}}, walls));
        const AtlasLayout coarse = Cells4::layout(grids[l + 1]);
        level.restrict.emplace(
            make(gpu, "restrict residual", "gles/fluid/restrict_residual.frag", l, coarse, {}, walls));
        Variant prolong;
        prolong.layouts = {{"COARSE", coarse}};
        prolong.defines = {{"COARSE_CELLS", glsl(grids[l + 1])}};
        if (l == 0 && least_residual_) prolong.defines.emplace_back("SHARE", fmt::format("{}", kThinShare));
        level.prolong.emplace(
            Split{Pass(gpu, fmt::format("prolong {}", l), "gles/fluid/prolong.frag", here, prolong), {}});
    }
}

Pressure::Split Pressure::make(Gpu& gpu, const char* name, const char* shader, std::size_t l,
                               const AtlasLayout& target, Variant variant, const Walls& walls) {
    const glm::ivec3 n = levels_[l].cells;
    variant.layouts.emplace_back("PHI", Cells4::layout(n));
    variant.layouts.emplace_back("FRACTION", Faces4::layout(n));
    variant.defines.emplace_back("CELLS", glsl(n));
    const glm::vec3 covered =
        glm::vec3(levels_[0].cells) / std::exp2(static_cast<float>(l)) - glm::vec3(n - 1);
    walls.declare(variant, covered);
    Variant cut = variant;
    if (covered != glm::vec3(1.0f))
        variant.defines.emplace_back(
            "LAST_CELL", fmt::format("vec3({:.8f}, {:.8f}, {:.8f})", covered.x, covered.y, covered.z));
    cut.defines.emplace_back("CUT", "");
    if (l > 0) cut.defines.emplace_back("COARSE", "");
    if (!fractions_) return {Pass(gpu, fmt::format("{} {}", name, l), shader, target, variant), {}};
    if (!levels_[l].split) return {Pass(gpu, fmt::format("{} {} cut", name, l), shader, target, cut), {}};
    return {Pass(gpu, fmt::format("{} {}", name, l), shader, target, variant),
            Pass(gpu, fmt::format("{} {} cut", name, l), shader, target, cut)};
}

void Pressure::draw(Split& pass, std::size_t l, std::vector<Input> inputs,
                    const std::vector<Uniform>& uniforms, const Texture& out, const std::vector<Box>& boxes,
                    const Region& where) {
    if (!fractions_) {
        pass.plain.draw(inputs, uniforms, {&out}, where);
        return;
    }
    const std::vector<Input> a = fractions_->level(l).inputs();
    inputs.insert(inputs.end(), a.begin(), a.end());
    pass.plain.draw(inputs, uniforms, {&out}, where);
    if (pass.cut) pass.cut->draw(inputs, uniforms, {&out}, Region::packed(boxes));
}

Field<Cells4> Pressure::sweep(std::size_t l, const Field<Cells4>& phi, const std::optional<Guess>& guess,
                              const Field<Cells4>& b, float omega) {
    Field<Cells4> next(*gpu_, levels_[l].cells, Format::RGBA32F);
    std::vector<Uniform> uniforms{{"omega", omega}};
    if (guess) uniforms.insert(uniforms.end(), {{"scale", guess->scale}, {"most_phi", guess->most_phi}});
    draw(guess ? *levels_[l].guess_sweep : *levels_[l].sweep, l,
         {{"phi", &phi.texture()}, {"b", &b.texture()}}, uniforms, next.texture(), levels_[l].boxes);
    return next;
}

Field<Cells4> Pressure::sweep_from_zero(std::size_t l, const Field<Cells4>& b, float omega) {
    Field<Cells4> next(*gpu_, levels_[l].cells, Format::RGBA32F);
    // The shader's phi is not read in this variant, but must be bound to something that is not being drawn
    // into.
    draw(*levels_[l].first_sweep, l, {{"phi", &b.texture()}, {"b", &b.texture()}}, {{"omega", omega}},
         next.texture(), levels_[l].boxes);
    return next;
}

void Pressure::sweep_rough(Field<Cells4>& phi, const Field<Cells4>& b, const std::vector<Box>& boxes) {
    // There and back: the first sweep covers what the second reads, so phi stays whole outside the boxes. Drawn are whole slabs
    // of four, each of which reads one beyond.
    Field<Cells4> there(*gpu_, levels_[0].cells, Format::RGBA32F);
    std::vector<Box> near = boxes, wider;
    for (Box& box : near) {
        box = box.grow(kRoughReach);
        wider.push_back({box.lo - glm::ivec3(1, 1, 4), box.hi + glm::ivec3(1, 1, 4)});
    }
    const auto sweep = [&](const Field<Cells4>& from, float omega, const Field<Cells4>& to,
                           const std::vector<Box>& where) {
        draw(*levels_[0].sweep, 0, {{"phi", &from.texture()}, {"b", &b.texture()}}, {{"omega", omega}},
             to.texture(), levels_[0].boxes, Region::packed(where));
    };
    sweep(phi, kSmoother[0], there, wider);
    sweep(there, kSmoother[1], phi, near);
}

Field<Cells4> Pressure::follow(Field<Cells4> phi, const std::vector<Displacement>& since, float most_phi) {
    Field<Cells4> moved(*gpu_, levels_[0].cells, Format::RGBA32F);
    for (const Displacement& body : since) {
        if (glm::length(body.moved) < 1e-3f) continue;
        const float reach = 3.0f * body.radius + 2.0f;
        const Box box{glm::ivec3(glm::floor(body.centre - reach)),
                      glm::ivec3(glm::ceil(body.centre + reach))};
        const Region region = Region::packed({box.intersect({glm::ivec3(0), levels_[0].cells})});
        follow_->draw({{"phi", &phi.texture()}},
                      {{"centre", body.centre},
                       {"moved", body.moved},
                       {"inner", 1.5f * body.radius},
                       {"reach", reach},
                       {"most_phi", most_phi}},
                      {&moved.texture()}, region);
        copy_back_->draw({{"field", &moved.texture()}}, {}, {&phi.texture()}, region);
    }
    return phi;
}

Field<Cells4> Pressure::cycle(std::size_t l, std::optional<Field<Cells4>> phi,
                              const std::optional<Guess>& guess, const Field<Cells4>& b) {
    Level& level = levels_[l];
    if (level.solve) {
        Field<Cells4> solved(*gpu_, level.cells, Format::RGBA32F);
        draw(*level.solve, l, {{"b", &b.texture()}}, {{"sweeps", static_cast<int>(solver_.size())}},
             solved.texture(), level.boxes);
        return solved;
    }
    Field<Cells4> p = phi ? sweep(l, *phi, guess, b, kSmoother[0]) : sweep_from_zero(l, b, kSmoother[0]);
    p = sweep(l, p, std::nullopt, b, kSmoother[1]);

    Field<Cells4> b_coarse(*gpu_, levels_[l + 1].cells, Format::RGBA32F);
    draw(*level.restrict, l, {{"phi", &p.texture()}, {"b", &b.texture()}}, {}, b_coarse.texture(),
         levels_[l + 1].boxes);
    const Field<Cells4> p_coarse = cycle(l + 1, std::nullopt, std::nullopt, b_coarse);
    Field<Cells4> corrected(*gpu_, level.cells, Format::RGBA32F);
    level.prolong->plain.draw({{"phi", &p.texture()}, {"phi_coarse", &p_coarse.texture()}}, {},
                              {&corrected.texture()});
    p = std::move(corrected);
    for (float omega : kSmoother) p = sweep(l, p, std::nullopt, b, omega);
    return p;
}

Field<Cells4> Pressure::solve(Field<Cells4> phi, const Field<Cells4>& b, const Work& work) {
    return cycles(std::move(phi), b, work);
}

Field<Cells4> Pressure::solve(const Field<Cells4>& b, const Work& work) {
    return cycles(std::nullopt, b, work);
}

Field<Cells4> Pressure::cycles(std::optional<Field<Cells4>> phi, const Field<Cells4>& b, const Work& work) {
    std::vector<Box> at_level = work.cut;
    for (Level& level : levels_) {
        level.boxes = at_level;
        for (Box& box : at_level) box = box.coarsen().grow(1);
    }
    if (least_residual_)
        phi = least_residual_cycles(phi, b, work);
    else
        for (int i = 0; i < work.cycles; ++i)
            phi = cycle(0, std::move(phi),
                        i == 0 ? std::optional(Guess{work.guess_scale, work.most_phi}) : std::nullopt, b);
    if (!work.rough.empty()) sweep_rough(*phi, b, work.rough);
    return *std::move(phi);
}

Field<Cells4> Pressure::residual(const Field<Cells4>& phi, const Field<Cells4>& b) {
    Field<Cells4> r(*gpu_, levels_[0].cells, Format::RGBA32F);
    draw(*residual_, 0, {{"phi", &phi.texture()}, {"b", &b.texture()}}, {}, r.texture(), levels_[0].boxes);
    return r;
}

Field<Cells4> Pressure::least_residual_cycles(const std::optional<Field<Cells4>>& guess,
                                              const Field<Cells4>& b, const Work& work) {
    Field<Cells4> phi(*gpu_, levels_[0].cells, Format::RGBA32F);
    if (guess)
        keep_->draw({{"phi", &guess->texture()}}, {{"scale", work.guess_scale}, {"most_phi", work.most_phi}},
                    {&phi.texture()});
    else
        clear(phi.texture());
    Field<Cells4> r = residual(phi, b);
    least_residual_->restart();
    for (int i = 0; i < work.cycles; ++i) {
        const Field<Cells4> z = cycle(0, std::nullopt, std::nullopt, r);
        least_residual_->correct(phi, r, z, residual(z, r));
    }
    return phi;
}

}  // namespace eddy::gles
