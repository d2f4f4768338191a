#include "gles/fluid/cut_cell.h"
#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// V-cycles that free a velocity of divergence that comes from another grid.
constexpr int kTakeOverCycles = 6;

}  // namespace

FluidState CutCellFluid::state() const {
    return {.setup = setup_,
            .bodies = bodies_,
            .steps = step_,
            .time_s = time_s_,
            .dt_s = dt_s_,
            .on_faces = &u_,
            .phi4 = &phi_,
            .smoke = smoke(),
            .temperature = temperature(),
            .diffused = diffused_ ? &diffused_ : nullptr,
            .coupling = coupling_ ? &*coupling_ : nullptr,
            .driven = &driven_,
            .force_methods = force_methods_ ? &*force_methods_ : nullptr};
}

void CutCellFluid::resume(const FluidState& from) {
    Gpu::Stage stage(gpu_, "take over");
    if (!resample_) resample_.emplace(gpu_, setup_.cells);
    const bool same_grid = from.on_faces && from.setup.cells == setup_.cells;
    results_.forget();
    step_ = from.steps;
    time_s_ = from.time_s;
    dt_s_ = from.dt_s;
    driven_.take_over(from.driven, time_s_);
    if (dt_s_ > 0.0) sound_ = sound(setup_, dt_s_);
    u_ = from.on_faces ? resample_->on_faces(*from.on_faces) : resample_->on_faces(*from.at_centres);
    if (!same_grid && step_ > 0) free_of_divergence();
    // dt p is the same; it is counted in rho h.
    const auto gain = static_cast<float>(from.setup.density_kg_m3 * from.setup.cell_m /
                                         (setup_.density_kg_m3 * setup_.cell_m));
    phi_ = from.phi4 ? resample_->in_fours(*from.phi4, gain) : resample_->in_fours(*from.phi, gain);
    if (smoke_) smoke_->take_over(from.smoke, *resample_);
    if (temperature_) temperature_->take_over(from.temperature, *resample_);
    diffused_ = {};
    if (viscosity_ && step_ > 0) {
        diffused_ = resample_->on_faces(from.diffused ? *from.diffused : u_);
        if (setup_.cell_m < 0.999 * from.setup.cell_m) settle();
    }
    if (coupling_ && !(same_grid && from.coupling && coupling_->copy(*from.coupling, *resample_))) {
        coupling_->reset();
        if (step_ > 0) {
            place(bodies_, 1.0f);
            coupling_->start(from.coupling, bodies_, fractions_->level(0), boxes_);
        }
    }
    if (force_methods_) {
        force_methods_->reset();
        if (same_grid && from.force_methods) force_methods_->take_over(*from.force_methods);
    }
}

void CutCellFluid::free_of_divergence() {
    Pressure::Work work = place(bodies_, 1.0f);
    work.cycles = kTakeOverCycles;
    Field<Cells4> phi(gpu_, setup_.cells, Format::RGBA32F);
    clear(phi.texture());
    phi = pressure_.solve(std::move(phi), divergence(u_), work);
    u_ = project(u_, phi, 1.0f);
}

void CutCellFluid::settle() {
    Pressure::Work work = place(bodies_, 1.0f);
    const Field<Faces> u =
        body_forces_ ? body_forces_->add_to(u_, smoke(), temperature(), time_s_, dt_s_) : std::move(u_);
    diffused_ = diffuse(u, work);
    phi_ = solve_pressure(Part::Whole, divergence(diffused_), work);
    u_ = project(diffused_, increment_, 1.0f);
}

}  // namespace eddy::gles
