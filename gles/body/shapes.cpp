#include "gles/body/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gles/body/distance_grid.h"
#include "gles/context.h"

namespace eddy::gles {
namespace {

/// A function that the distances of some shapes call. Later ones may call earlier ones.
struct Function {
    const char* name;
    const char* text;
};

/// Distances of shapes, in cells, from p in the shape's own frame.
constexpr Function kFunctions[] = {
    {"in_body", R"(
uniform vec3 body_axes[3 * BODIES];
vec3 in_body(vec3 x, int b) {
    return (x - body_centre[b]) * mat3(body_axes[3 * b], body_axes[3 * b + 1], body_axes[3 * b + 2]);
}
)"},
    {"cuboid_distance", R"(
float cuboid_distance(vec3 p, vec3 half_size) {
    vec3 d = abs(p) - half_size;
    return length(max(d, 0.0)) + min(max(d.x, max(d.y, d.z)), 0.0);
}
)"},
    {"capsule_distance", R"(
float capsule_distance(vec3 p, float radius, float half_length) {
    return length(vec3(p.x, p.y - clamp(p.y, -half_length, half_length), p.z)) - radius;
}
)"},
    {"cylinder_distance", R"(
float cylinder_distance(vec3 p, float radius, float half_length) {
    vec2 d = vec2(length(p.xz) - radius, abs(p.y) - half_length);
    return length(max(d, 0.0)) + min(max(d.x, d.y), 0.0);
}
)"},
    {"torus_distance", R"(
float torus_distance(vec3 p, float radius, float tube_radius) {
    return length(vec2(length(p.xz) - radius, p.y)) - tube_radius;
}
)"},
    // f is 0 at the centre and 1 on the surface; (f - 1) / |grad f| is right to first order.
    {"ellipsoid_distance", R"(
float ellipsoid_distance(vec3 p, vec3 radii) {
    float f = length(p / radii), f_times_gradient = length(p / (radii * radii));
    return (f - 1.0) * (f > 1e-6 ? f / f_times_gradient : min(radii.x, min(radii.y, radii.z)));
}
)"},
    {"paddle_distance", R"(
uniform vec3 body_handle[BODIES];
float paddle_distance(vec3 p, vec3 half_blade, vec3 handle) {
    float blade = cuboid_distance(p, half_blade);
    return min(blade, cylinder_distance(p - vec3(0.0, handle.y, 0.0), handle.x, handle.y));
}
)"},
    // Corners a (1, 1, 1), a (1, -1, -1), a (-1, 1, -1), a (-1, -1, 1). Its mirrors take every p to where
    // x >= y >= |z|; there are one face, x + y - z = a, one edge, x = a and y = z, and that edge's end.
    {"tetrahedron_distance", R"(
float tetrahedron_distance(vec3 p, float a) {
    vec3 q = abs(p);
    float most = max(q.x, max(q.y, q.z)), least = min(q.x, min(q.y, q.z));
    float middle = max(min(q.x, q.y), min(max(q.x, q.y), q.z));
    q = vec3(most, middle, p.x * p.y * p.z < 0.0 ? -least : least);
    float face = (q.x + q.y - q.z - a) * inversesqrt(3.0);
    if (face <= 0.0 || 2.0 * q.x - q.y + q.z <= 2.0 * a) return face;
    float t = min(0.5 * (q.y + q.z), a);
    return length(q - vec3(a, t, t));
}
)"},
    // The same as DistanceGrid::at.
    {"mesh_distance", R"(
float mesh_distance(sampler2D grid, const Layout nodes, vec3 low, vec3 p, float spacing) {
    vec3 s = p / spacing - low;
    vec3 inside = clamp(s, vec3(0.0), vec3(nodes.size - 1));
    float d = sample_linear(grid, nodes, inside + 0.5).x;
    float beyond = dot(s - inside, s - inside);
    return spacing * (beyond > 0.0 ? sqrt(d * d + beyond) : d);
}
)"},
};

/// The distance grids of a scene, each once: bodies may share one.
std::vector<const DistanceGrid*> distance_grids(const std::vector<BodySetup>& bodies) {
    std::vector<const DistanceGrid*> grids;
    for (const BodySetup& body : bodies)
        if (const Mesh* mesh = std::get_if<Mesh>(&body.shape))
            if (std::find(grids.begin(), grids.end(), mesh->distance.get()) == grids.end())
                grids.push_back(mesh->distance.get());
    return grids;
}

std::string texture_name(std::size_t grid) {
    return fmt::format("body_distance_{}", grid);
}

/// The grid's texture and layout as the declarations name them.
std::string declaration(const DistanceGrid& grid, std::size_t number) {
    return fmt::format("uniform sampler2D {};\n", texture_name(number)) +
           Cells::layout(grid.nodes()).declaration(fmt::format("BODY_GRID_{}", number));
}

/// GLSL expression for the signed distance from x to body number b.
struct DistanceOf {
    std::size_t b;
    const std::vector<const DistanceGrid*>& grids;

    std::string operator()(const Sphere&) const {
        return fmt::format("length(x - body_centre[{0}]) - body_size[{0}].x", b);
    }
    std::string operator()(const Cuboid&) const { return call("cuboid", ""); }
    std::string operator()(const Capsule&) const { return call("capsule", ".x, body_size[{0}].y"); }
    std::string operator()(const Cylinder&) const { return call("cylinder", ".x, body_size[{0}].y"); }
    std::string operator()(const Torus&) const { return call("torus", ".x, body_size[{0}].y"); }
    std::string operator()(const Ellipsoid&) const { return call("ellipsoid", ""); }
    std::string operator()(const Paddle&) const { return call("paddle", ", body_handle[{0}]"); }
    std::string operator()(const Tetrahedron&) const { return call("tetrahedron", ".x"); }
    std::string operator()(const Mesh& mesh) const {
        const auto number = std::find(grids.begin(), grids.end(), mesh.distance.get()) - grids.begin();
        const glm::dvec3 low = mesh.distance->low_m() / mesh.distance->spacing_m();
        return fmt::format(
            "mesh_distance({0}, BODY_GRID_{1}, vec3({2:.9g}, {3:.9g}, {4:.9g}), in_body(x, {5}), "
            "body_size[{5}].x)",
            texture_name(static_cast<std::size_t>(number)), number, low.x, low.y, low.z, b);
    }

  private:
    /// `sizes`: what follows "body_size[b]".
    std::string call(const char* shape, const char* sizes) const {
        return fmt::format("{1}_distance(in_body(x, {0}), body_size[{0}]{2})", b, shape,
                           fmt::format(fmt::runtime(sizes), b));
    }
};

std::string distance_expression(const std::vector<BodySetup>& bodies, std::size_t b,
                                const std::vector<const DistanceGrid*>& grids) {
    const std::string distance = std::visit(DistanceOf{b, grids}, bodies[b].shape);
    return bodies[b].inside_out ? fmt::format("-({})", distance) : distance;
}

/// What a shape's distance takes as body_size, times the cell width [m].
struct SizeOf {
    glm::dvec3 operator()(const Sphere& s) const { return {s.radius_m, 0.0, 0.0}; }
    glm::dvec3 operator()(const Cuboid& s) const { return 0.5 * s.size_m; }
    glm::dvec3 operator()(const Capsule& s) const { return {s.radius_m, 0.5 * s.length_m, 0.0}; }
    glm::dvec3 operator()(const Cylinder& s) const { return {s.radius_m, 0.5 * s.length_m, 0.0}; }
    glm::dvec3 operator()(const Torus& s) const { return {s.radius_m, s.tube_radius_m, 0.0}; }
    glm::dvec3 operator()(const Ellipsoid& s) const { return s.radii_m; }
    glm::dvec3 operator()(const Paddle& s) const { return 0.5 * s.blade_m; }
    glm::dvec3 operator()(const Tetrahedron& s) const { return {s.edge_m * std::sqrt(1.0 / 8.0), 0.0, 0.0}; }
    glm::dvec3 operator()(const Mesh& s) const { return {s.distance->spacing_m(), 0.0, 0.0}; }
};

/// Radius and half length of a paddle's handle [m].
glm::dvec3 handle_m(const Shape& shape) {
    const Paddle* paddle = std::get_if<Paddle>(&shape);
    if (!paddle) return glm::dvec3(0.0);
    return {paddle->handle_radius_m, 0.5 * (0.5 * paddle->blade_m.y + paddle->handle_length_m), 0.0};
}

/// The frame in which a shape's distance is written, in that of its body.
glm::dmat3 own_frame(const Shape& shape) {
    if (!std::holds_alternative<Tetrahedron>(shape)) return glm::dmat3(1.0);
    // Its corner (1, 1, 1) is on the body's +y, and its corner (1, -1, -1) at x = 0, z > 0.
    const glm::dvec3 y = glm::normalize(glm::dvec3(1.0, 1.0, 1.0));
    const glm::dvec3 z = glm::normalize(glm::dvec3(2.0, -1.0, -1.0));
    return glm::transpose(glm::dmat3(glm::cross(y, z), y, z));
}

TexturePool::Lease upload(Gpu& gpu, const DistanceGrid& grid) {
    const AtlasLayout layout = Cells::layout(grid.nodes());
    const glm::ivec3 n = grid.nodes();
    std::vector<float> texels(static_cast<std::size_t>(layout.texels().x * layout.texels().y), 0.0f);
    auto distance = grid.distances().begin();
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) {
                const glm::ivec2 t = layout.texel({x, y, z});
                texels[static_cast<std::size_t>(t.y * layout.texels().x + t.x)] = *distance++;
            }
    TexturePool::Lease texture = gpu.textures().lease(layout.texels(), Format::R32F);
    texture.get()->upload(texels.data());
    return texture;
}

}  // namespace

std::string shape_declarations(const std::vector<BodySetup>& bodies) {
    if (bodies.empty()) return "";
    const std::vector<const DistanceGrid*> grids = distance_grids(bodies);
    const auto distance = [&](std::size_t b) { return distance_expression(bodies, b, grids); };

    std::string text = "float solid_distance(vec3 x) {\n";
    text += fmt::format("    float d = {};\n", distance(0));
    for (std::size_t b = 1; b < bodies.size(); ++b) text += fmt::format("    d = min(d, {});\n", distance(b));
    text += "    return d;\n}\n";

    text += "int nearest_body(vec3 x) {\n    int nearest = 0;\n";
    if (bodies.size() > 1) {
        text += fmt::format("    float d = {}, e;\n", distance(0));
        for (std::size_t b = 1; b < bodies.size(); ++b)
            text += fmt::format("    e = {};\n    if (e < d) {{ d = e; nearest = {}; }}\n", distance(b), b);
    }
    text += "    return nearest;\n}\n";
    text +=
        "vec3 solid_velocity(vec3 x) {\n"
        "    int b = nearest_body(x);\n"
        "    return body_velocity[b] + cross(body_spin[b], x - body_centre[b]);\n}\n";

    // In front, what is called so far: the functions, then the textures, then what every scene has.
    for (auto function = std::rbegin(kFunctions); function != std::rend(kFunctions); ++function)
        if (text.find(function->name) != std::string::npos) text = function->text + text;
    for (std::size_t i = 0; i < grids.size(); ++i) text = declaration(*grids[i], i) + text;
    return fmt::format("const int BODIES = {};\n", bodies.size()) +
           "uniform vec3 body_centre[BODIES], body_size[BODIES], body_velocity[BODIES], "
           "body_spin[BODIES];\n" +
           text;
}

BodyUniforms::BodyUniforms(Gpu& gpu, const std::vector<BodySetup>& bodies, double cell_m)
    : cell_m_(cell_m),
      centre_(bodies.size()),
      velocity_(bodies.size()),
      spin_(bodies.size()),
      axes_(3 * bodies.size()) {
    for (const BodySetup& body : bodies) {
        size_.emplace_back(std::visit(SizeOf{}, body.shape) / cell_m);
        handle_.emplace_back(handle_m(body.shape) / cell_m);
        frames_.push_back(own_frame(body.shape));
    }
    for (const DistanceGrid* grid : distance_grids(bodies)) {
        input_names_.push_back(texture_name(distances_.size()));
        distances_.push_back(upload(gpu, *grid));
    }
    for (std::size_t i = 0; i < distances_.size(); ++i)
        inputs_.push_back({input_names_[i].c_str(), distances_[i].get()});
}

void BodyUniforms::set(const std::vector<BodyState>& states) {
    for (std::size_t b = 0; b < states.size(); ++b) {
        centre_[b] = glm::vec3(states[b].centre_m / cell_m_);
        velocity_[b] = glm::vec3(states[b].velocity_m_s);
        spin_[b] = glm::vec3(states[b].spin_rad_s * cell_m_);
        const glm::dmat3 axes = glm::mat3_cast(glm::normalize(states[b].orientation)) * frames_[b];
        for (int k = 0; k < 3; ++k) axes_[3 * b + static_cast<std::size_t>(k)] = glm::vec3(axes[k]);
    }
}

std::vector<Uniform> BodyUniforms::uniforms() const {
    return {{"body_centre", centre_}, {"body_size", size_}, {"body_velocity", velocity_},
            {"body_spin", spin_},     {"body_axes", axes_}, {"body_handle", handle_}};
}

}  // namespace eddy::gles
