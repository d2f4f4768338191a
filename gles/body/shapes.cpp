#include "gles/body/shapes.h"

#include <fmt/format.h>

namespace eddy::gles {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

/// GLSL expression for the signed distance from x to body number b.
std::string distance_expression(const Shape& shape, std::size_t b) {
    return std::visit(Overloaded{[&](const Sphere&) {
                          return fmt::format("length(x - body_centre[{0}]) - body_size[{0}].x", b);
                      }},
                      shape);
}

glm::vec3 size_cells(const Shape& shape, double cell_m) {
    return std::visit(Overloaded{[&](const Sphere& s) { return glm::vec3(s.radius_m / cell_m, 0.0, 0.0); }},
                      shape);
}

}  // namespace

std::string shape_declarations(const std::vector<BodySetup>& bodies) {
    if (bodies.empty()) return "";
    std::string text =
        fmt::format("uniform vec3 body_centre[{0}], body_size[{0}], body_velocity[{0}], body_spin[{0}];\n",
                    bodies.size());
    text += "float solid_distance(vec3 x) {\n";
    text += fmt::format("    float d = {};\n", distance_expression(bodies[0].shape, 0));
    for (std::size_t b = 1; b < bodies.size(); ++b)
        text += fmt::format("    d = min(d, {});\n", distance_expression(bodies[b].shape, b));
    text += "    return d;\n}\n";

    text += "int nearest_body(vec3 x) {\n    int nearest = 0;\n";
    if (bodies.size() > 1) {
        text += fmt::format("    float d = {}, e;\n", distance_expression(bodies[0].shape, 0));
        for (std::size_t b = 1; b < bodies.size(); ++b)
            text += fmt::format("    e = {};\n    if (e < d) {{ d = e; nearest = {}; }}\n",
                                distance_expression(bodies[b].shape, b), b);
    }
    text += "    return nearest;\n}\n";
    text +=
        "vec3 solid_velocity(vec3 x) {\n"
        "    int b = nearest_body(x);\n"
        "    return body_velocity[b] + cross(body_spin[b], x - body_centre[b]);\n}\n";
    return text;
}

BodyUniforms::BodyUniforms(const std::vector<BodySetup>& bodies, double cell_m)
    : cell_m_(cell_m), centre_(bodies.size()), velocity_(bodies.size()), spin_(bodies.size()) {
    for (const BodySetup& body : bodies) size_.push_back(size_cells(body.shape, cell_m));
}

void BodyUniforms::set(const std::vector<BodyState>& states) {
    for (std::size_t b = 0; b < states.size(); ++b) {
        centre_[b] = glm::vec3(states[b].centre_m / cell_m_);
        velocity_[b] = glm::vec3(states[b].velocity_m_s);
        spin_[b] = glm::vec3(states[b].spin_rad_s * cell_m_);
    }
}

double bounding_radius_m(const Shape& shape) {
    return std::visit(Overloaded{[](const Sphere& s) { return s.radius_m; }}, shape);
}

Box body_box(const Shape& shape, const BodyState& state, double cell_m, const glm::ivec3& cells) {
    const double reach = bounding_radius_m(shape) / cell_m + 2.0;
    const glm::dvec3 centre = state.centre_m / cell_m;
    const Box box{glm::ivec3(glm::floor(centre - reach)), glm::ivec3(glm::ceil(centre + reach))};
    return box.intersect({glm::ivec3(0), cells});
}

}  // namespace eddy::gles
