#include "gles/fluid/imposed.h"

#include <fmt/format.h>

#include <stdexcept>

#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

FluidSetup open_all_around(FluidSetup setup) {
    setup.walls.fill({.kind = WallKind::Open});
    return setup;
}

Variant flow_variant(const FluidSetup& setup) {
    const auto& u = setup.imposed->velocity_m_s.glsl;
    return {.defines = {{"CELLS", glsl(setup.cells)}},
            .declarations =
                setup.formula_helpers + kWhereFinite +
                fmt::format("uniform float time;  // [s]\nvec3 imposed_velocity(vec3 cells) {{\n{}    "
                            "return where_finite(vec3({}, {}, {}));\n}}\n",
                            formula_variables(setup.cell_m, "time"), u[0], u[1], u[2])};
}

}  // namespace

ImposedFluid::ImposedFluid(Gpu& gpu, FluidSetup setup)
    : Fluid(open_all_around(std::move(setup))),
      gpu_(gpu),
      walls_(setup_),
      flow_(gpu, "imposed flow", "gles/fluid/imposed_flow.frag", Faces::layout(setup_.cells),
            flow_variant(setup_)),
      health_(gpu, setup_),
      diagnosis_(gpu, setup_),
      results_(gpu, setup_) {
    if (const auto smoke = Scalar::smoke(setup_)) smoke_.emplace(gpu, setup_, *smoke, walls_, nullptr);
    if (const auto heat = Scalar::temperature(setup_))
        temperature_.emplace(gpu, setup_, *heat, walls_, nullptr);
}

void ImposedFluid::start_over() {
    if (smoke_) smoke_->reset();
    if (temperature_) temperature_->reset();
    results_.forget();
    step_ = 0;
    time_s_ = 0.0;
}

void ImposedFluid::move_on(double dt_s, const std::vector<BodyState>&, bool wants_diagnosis) {
    health_.draw({.smoke = smoke(), .temperature = temperature()}, sound(setup_, dt_s), results_.row());
    if (!u_ || !setup_.imposed->steady) {
        Gpu::Stage stage(gpu_, "imposed flow");
        u_ = flow_at(time_s_ + 0.5 * dt_s);  // of second order in time
    }
    if (smoke_) smoke_->step(u_, time_s_, dt_s, walls_.time(time_s_));  // s = s(x - dt u) + dt q
    if (temperature_)
        temperature_->step(u_, time_s_, dt_s,
                           walls_.time(time_s_));  // T - kappa dt lap T = T(x - dt u) + dt q
    time_s_ += dt_s;
    ++step_;
    if (wants_diagnosis) {
        Gpu::Stage stage(gpu_, "diagnose");
        diagnose();
    }
    Gpu::Stage stage(gpu_, "read back");
    results_.request(step_, dt_s, wants_diagnosis);
}

FluidState ImposedFluid::state() const {
    return {.setup = setup_,
            .bodies = bodies_,
            .steps = step_,
            .time_s = time_s_,
            .smoke = smoke(),
            .temperature = temperature()};
}

void ImposedFluid::resume(const FluidState& from) {
    Gpu::Stage stage(gpu_, "take over");
    if (!resample_) resample_.emplace(gpu_, setup_.cells);
    if (smoke_) smoke_->take_over(from.smoke, *resample_);
    if (temperature_) temperature_->take_over(from.temperature, *resample_);
    results_.forget();
    step_ = from.steps;
    time_s_ = from.time_s;
}

Field<Faces> ImposedFluid::flow_at(double time_s) const {
    Field<Faces> u(gpu_, setup_.cells, Format::RGBA32F);
    flow_.draw({}, {{"time", static_cast<float>(time_s)}}, {&u.texture()});
    return u;
}

void ImposedFluid::diagnose() {
    const AtlasLayout cells = Cells4::layout(setup_.cells);
    if (!divergence_) {
        Variant variant{.layouts = {{"FACES", Faces::layout(setup_.cells)}},
                        .defines = {{"CELLS", glsl(setup_.cells)}}};
        walls_.declare(variant);
        divergence_.emplace(gpu_, "divergence", "gles/fluid/divergence.frag", cells, variant);
    }
    const Field<Faces> u = flow_at(time_s_);
    const Field<Cells4> b(gpu_, setup_.cells, Format::RGBA32F);
    divergence_->draw({{"velocity", &u.texture()}}, {walls_.time(time_s_)}, {&b.texture()});
    diagnosis_.draw({u, b, b, smoke(), temperature()}, results_.row());
}

std::vector<glm::vec3> ImposedFluid::velocity() const {
    const Field<Faces> u = flow_at(time_s_);
    return unpack_vectors(u.texture().download(), u.layout());
}

std::vector<float> ImposedFluid::pressure() const {
    throw std::logic_error("an imposed flow has no pressure");
}

void ImposedFluid::set_velocity(const std::vector<glm::vec3>&) {
    throw std::logic_error("an imposed flow was given another velocity");
}

}  // namespace eddy::gles
