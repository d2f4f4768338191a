#include "gles/fluid/results.h"

#include <algorithm>
#include <cmath>

namespace eddy::gles {

int Results::width(const FluidSetup& setup) {
    return diagnosis_texel(setup).x + (setup.temperature ? 3 : 2);
}

bool Results::measures(const FluidSetup& setup) {
    return std::any_of(setup.bodies.begin(), setup.bodies.end(),
                       [](const BodySetup& b) { return b.force || b.torque; });
}

Results::Results(Gpu& gpu, const FluidSetup& setup)
    : setup_(&setup),
      row_(gpu.textures().lease({width(setup), 1}, Format::RGBA32F)),
      readback_(gpu, {width(setup), 1}) {}

void Results::request(long step, double dt_s, bool diagnosed) {
    asked_[static_cast<std::size_t>(step) % asked_.size()] = {dt_s, diagnosed};
    readback_.request(*row_, step);
}

void Results::forget() {
    while (readback_.under_way() > 0) readback_.take(true);
}

std::optional<StepResult> Results::take(bool wait) {
    const auto got = readback_.take(wait);
    if (!got) return std::nullopt;
    const Asked& asked = asked_[static_cast<std::size_t>(got->tag) % asked_.size()];
    const double h = setup_->cell_m, volume = h * h * h;
    // With phi = dt p / (rho h):  p h^2 = phi rho h^3 / dt.
    const double newton = setup_->density_kg_m3 * volume / asked.dt_s;

    StepResult result;
    result.step = got->tag;
    for (std::size_t i = 0; i < setup_->bodies.size(); ++i) {
        Load load;
        if (setup_->bodies[i].force) load.force_n = newton * glm::dvec3(got->texels[2 * i]);
        if (setup_->bodies[i].torque) load.torque_nm = newton * h * glm::dvec3(got->texels[2 * i + 1]);
        result.loads.push_back(load);
    }
    const auto texel = [&](const glm::ivec2& at) {
        return glm::dvec4(got->texels[static_cast<std::size_t>(at.x)]);
    };
    const glm::dvec4 found = texel(health_texel(*setup_));
    result.health = {std::lround(found.x), std::lround(found.y), std::lround(found.z), found.w};
    if (asked.diagnosed) {
        const glm::dvec4 d = texel(diagnosis_texel(*setup_));
        result.diagnostics =
            Diagnostics{d.w / h, d.x / h, 0.5 * setup_->density_kg_m3 * volume * d.y, d.z * volume};
        if (setup_->temperature)
            result.diagnostics->temperature_total = texel(heat_texel(*setup_)).x * volume;
    }
    return result;
}

}  // namespace eddy::gles
