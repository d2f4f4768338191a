#include "firmware/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "gles/grid_io.h"

namespace eddy {
namespace {

/// One number at each point of a grid: where in the array it is, and where in the tank.
struct Samples {
    const float* first;
    std::size_t stride = 1;  ///< floats from one point to the next
    glm::ivec3 stored;       ///< points in the array along x, y, z
    glm::ivec3 used;         ///< of those the ones that mean something
    glm::dvec3 origin;       ///< of the first point [cells]

    float value(const glm::ivec3& i) const {
        return first[stride * static_cast<std::size_t>(i.x + stored.x * (i.y + stored.y * i.z))];
    }
};

double read_at(const Samples& samples, const glm::dvec3& x_cells) {
    const glm::dvec3 p = x_cells - samples.origin;
    const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), samples.used - 2);
    const glm::dvec3 share = p - glm::dvec3(low);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 up(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::dvec3 w = glm::mix(1.0 - share, share, glm::dvec3(up));
        sum += w.x * w.y * w.z * static_cast<double>(samples.value(low + up));
    }
    return sum;
}

Samples in_cells(const float* first, const glm::ivec3& n) {
    return {first, 1, n, n, glm::dvec3(0.5)};
}

/// A component of the velocity, on the faces across it or, where there is one for each cell, in the middle of the cells.
Samples component(const std::vector<glm::vec3>& u, int axis, const glm::ivec3& n) {
    const bool collocated = u.size() == static_cast<std::size_t>(n.x * n.y * n.z);
    Samples samples{&u[0].x + axis, 3, n, n, glm::dvec3(0.5)};
    if (collocated) return samples;
    samples.stored += 1;
    samples.used[axis] += 1;
    samples.origin[axis] = 0.0;
    return samples;
}

std::vector<const char*> units(ProbeQuantity quantity) {
    switch (quantity) {
        case ProbeQuantity::Velocity:
            return {"velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"};
        case ProbeQuantity::Pressure:
            return {"pressure_pa"};
        case ProbeQuantity::Smoke:
            return {"smoke"};
        case ProbeQuantity::Temperature:
            return {"temperature_k"};
    }
    throw std::logic_error("a probe without a column");
}

std::vector<float> download(const gles::Field<gles::Cells>& scalar) {
    return gles::unpack_scalars(scalar.texture().download(), scalar.layout());
}

}  // namespace

Probes::Probes(const Scene& scene)
    : probes_(scene.probes), cells_(scene.tank.cells), cell_m_(scene.tank.cell_m()) {}

bool Probes::any(ProbeQuantity quantity) const {
    return std::any_of(probes_.begin(), probes_.end(),
                       [&](const Scene::Probe& probe) { return probe.quantity == quantity; });
}

std::vector<std::string> Probes::columns() const {
    std::vector<std::string> columns;
    for (const Scene::Probe& probe : probes_)
        for (std::size_t i = 1; i <= probe.places_m().size(); ++i)
            for (const char* unit : units(probe.quantity))
                columns.push_back(probe.point_m ? fmt::format("{}_{}", probe.name, unit)
                                                : fmt::format("{}_{}_{}", probe.name, i, unit));
    return columns;
}

std::vector<double> Probes::read(const gles::Fluid& fluid) const {
    std::vector<glm::vec3> velocity;
    std::map<ProbeQuantity, std::vector<float>> scalars;
    if (any(ProbeQuantity::Velocity)) velocity = fluid.velocity();
    if (any(ProbeQuantity::Pressure)) scalars[ProbeQuantity::Pressure] = fluid.pressure();
    if (any(ProbeQuantity::Smoke)) scalars[ProbeQuantity::Smoke] = download(*fluid.smoke());
    if (any(ProbeQuantity::Temperature)) scalars[ProbeQuantity::Temperature] = download(*fluid.temperature());

    std::vector<double> values;
    for (const Scene::Probe& probe : probes_)
        for (const glm::dvec3& place_m : probe.places_m()) {
            const glm::dvec3 x = place_m / cell_m_;
            if (probe.quantity != ProbeQuantity::Velocity)
                values.push_back(read_at(in_cells(scalars[probe.quantity].data(), cells_), x));
            else
                for (int axis = 0; axis < 3; ++axis)
                    values.push_back(read_at(component(velocity, axis, cells_), x));
        }
    return values;
}

}  // namespace eddy
