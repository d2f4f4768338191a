#include <algorithm>
#include <cmath>

#include "firmware/accuracy/case.h"
#include "gles/body/bounds.h"
#include "gles/body/mass_properties.h"

// B1   A solid held in a fluid at rest is pushed up with the weight of the fluid it displaces, whatever its shape, its pose
//      and where it lies between the cells. The force comes from the pressure that was solved for.

namespace eddy::accuracy {
namespace {

/// Force up on body i over the weight of the fluid it displaces.
double buoyancy(const Run& run, const gles::StepResult& result, std::size_t i) {
    const gles::FluidSetup& setup = run.setup();
    const double volume = gles::mass_properties(setup.bodies[i].shape).volume_m3;
    const glm::dvec3 weight = setup.density_kg_m3 * volume * setup.gravity_m_s2;
    return -glm::dot(result.loads[i].force_n, weight) / glm::dot(weight, weight);
}

/// Torque on body i about its middle of volume, over the weight of the fluid it displaces and its greatest radius.
double torque(const Run& run, const gles::StepResult& result, std::size_t i) {
    const gles::FluidSetup& setup = run.setup();
    const gles::Shape& shape = setup.bodies[i].shape;
    const gles::MassProperties solid = gles::mass_properties(shape);
    const gles::Load& load = result.loads[i];
    const glm::dvec3 arm = run.fluid().bodies()[i].orientation * solid.centre_m;
    const double weight = setup.density_kg_m3 * solid.volume_m3 * glm::length(setup.gravity_m_s2);
    return glm::length(load.torque_nm - glm::cross(arm, load.force_n)) /
           (weight * gles::bounding_radius_m(shape));
}

/// The ball at places along a diagonal through one cell; the value that is furthest from 1.
std::vector<double> worst_of_places(Laboratory& lab) {
    constexpr int kPlaces = 20;
    double worst = 1.0;
    for (int i = 0; i < kPlaces; ++i) {
        Scene scene = lab.scene();
        scene.bodies[0].centre_m += scene.tank.cell_m() * i / kPlaces * glm::dvec3(1.0, 0.7, 0.4);
        Run run = lab.start(scene);
        const double share = buoyancy(run, run.step_to_end(), 0);
        if (!std::isfinite(share)) return {share};
        if (std::abs(share - 1.0) > std::abs(worst - 1.0)) worst = share;
    }
    return {worst};
}

std::vector<double> each_shape(Laboratory& lab) {
    Run run = lab.start();
    const gles::StepResult result = run.step_to_end();
    std::vector<double> shares;
    double worst = 0.0;
    for (std::size_t i = 0; i < lab.scene().bodies.size(); ++i) {
        shares.push_back(buoyancy(run, result, i));
        const double turning = torque(run, result, i);
        if (!(turning <= worst) && !std::isnan(worst)) worst = turning;  // not a number is not "none"
    }
    shares.push_back(worst);
    return shares;
}

}  // namespace

std::vector<Case> archimedes_cases() {
    const auto share = [](const std::string& name, const Limit& limit) {
        return Quantity{.name = name,
                        .exact = 1.0,
                        .source = "Archimedes",
                        .error = Quantity::Error::Relative,
                        .limits = {limit}};
    };
    std::vector<Quantity> shapes;
    for (const Scene::Body& body : load_scene("validation/B1-shapes").scene.bodies)
        shapes.push_back(share(body.name, {80, 0.005}));
    shapes.push_back({.name = "greatest torque / (weight radius)",
                      .exact = 0.0,
                      .source = "Archimedes: the push goes through the middle of the volume",
                      .limits = {{80, 0.005}}});
    return {{.name = "B1-sphere",
             .title = "buoyancy of a ball over the water's weight, the worst of 20 places within a cell",
             .scene = "validation/B1-sphere",
             .quick = {16, 24},
             .full = {16, 24, 32, 48},
             .quantities = {share("force / weight", {16, 0.002})},
             .measure = worst_of_places},
            {.name = "B1-shapes",
             .title = "buoyancy and torque of every shape over the water's weight",
             .scene = "validation/B1-shapes",
             .quick = {80},
             .full = {80, 120, 160},
             .quantities = shapes,
             .measure = each_shape}};
}

}  // namespace eddy::accuracy
