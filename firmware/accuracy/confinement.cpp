#include <algorithm>
#include <cmath>

#include "firmware/accuracy/case.h"
#include "firmware/vorticity.h"

// A18  Vorticity confinement, f = eps h (grad |w| / |grad |w||) x w (Fedkiw, Stam, Jensen 2001): what it gives to an eddy, and
//      that it pushes the fluid as a whole nowhere.

namespace eddy::accuracy {
namespace {

/// f in the middle of each cell and what it does there, worked out anew on the CPU.
struct Confinement {
    double power_w_kg = 0.0;  // sum of f . u over the number of cells  [W/kg]
    glm::dvec3 sum{0.0};      // of f
    double sum_of_lengths = 0.0;
};

void for_each_cell(const glm::ivec3& n, const std::function<void(const glm::ivec3&)>& visit) {
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) visit({x, y, z});
}

glm::ivec3 unit(int k) {
    glm::ivec3 e(0);
    e[k] = 1;
    return e;
}

Confinement confinement(const FaceVelocity& faces, double strength_1_s) {
    const glm::ivec3 n = faces.cells();
    const std::vector<glm::vec3> u = velocity_in_cells(faces.values(), n),
                                 w = vorticity(faces.values(), n, faces.cell_m());
    const auto at = [&n](const std::vector<glm::vec3>& field, const glm::ivec3& c) {
        const glm::ivec3 i = glm::clamp(c, glm::ivec3(0), n - 1);
        return glm::dvec3(field[static_cast<std::size_t>((i.z * n.y + i.y) * n.x + i.x)]);
    };
    Confinement result;
    for_each_cell(n, [&](const glm::ivec3& c) {
        glm::dvec3 g;
        for (int k = 0; k < 3; ++k) g[k] = glm::length(at(w, c + unit(k))) - glm::length(at(w, c - unit(k)));
        const glm::dvec3 f =
            strength_1_s * faces.cell_m() * glm::cross(g / std::max(glm::length(g), 1e-30), at(w, c));
        result.power_w_kg += glm::dot(f, at(u, c)) / (n.x * n.y * n.z);
        result.sum += f;
        result.sum_of_lengths += glm::length(f);
    });
    return result;
}

/// Energy that confinement adds in the first step over f . u dt, net push, and what a strength of 0 changes.
std::vector<double> feeding(Laboratory& lab) {
    Scene without = lab.scene(), zero = lab.scene();
    without.vorticity_confinement.reset();
    zero.vorticity_confinement->strength_1_s = 0.0;
    Run fed = lab.start(), plain = lab.start(without), off = lab.start(zero);
    // The force is worked out from the velocity as the transport leaves it: that of the fluid without the force.
    fed.step();
    plain.step();
    off.step();
    const FaceVelocity u = plain.velocity(), same = off.velocity();
    const Confinement f = confinement(u, lab.scene().vorticity_confinement->strength_1_s);
    const double gained = (fed.velocity().energy() - u.energy()) / fed.dt_s();
    double changed = 0.0;
    u.for_each_face([&](const glm::ivec3& c, int k, double) {
        const double change = std::abs(same.at(c, k) - u.at(c, k));
        if (!(change <= changed) && !std::isnan(changed)) changed = change;  // not a number is not "none"
    });
    return {gained / f.power_w_kg, glm::length(f.sum) / f.sum_of_lengths, changed};
}

}  // namespace

std::vector<Case> confinement_cases() {
    return {{.name = "A18",
             .title = "vorticity confinement feeds an eddy and pushes it nowhere",
             .scene = "validation/A18",
             .quick = {32},
             .full = {32, 64},
             .quantities = {{.name = "power / sum of f.u",
                             .exact = 1.0,
                             .source = "work of the force as Fedkiw, Stam and Jensen 2001 define it",
                             .error = Quantity::Error::Relative,
                             .limits = {{32, 0.05}}},
                            {.name = "|sum of f| / sum of |f|",
                             .source = "a round eddy has no preferred side",
                             .limits = {{32, 0.01}}},
                            {.name = "change by eps = 0 [m/s]", .source = "nothing", .limits = {{32, 0.0}}}},
             .measure = feeding}};
}

}  // namespace eddy::accuracy
