#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "config/scene_rules.h"

namespace eddy {
namespace {

// The radius of a ball around the centre that holds the whole body; that of a mesh is in its file.
double reach_m(const Scene::Body& body) {
    switch (body.shape) {
        case BodyShape::Sphere:
            return body.radius_m;
        case BodyShape::Box:
            return 0.5 * glm::length(body.size_m);
        case BodyShape::Capsule:
            return 0.5 * body.length_m + body.radius_m;
        case BodyShape::Cylinder:
            return std::hypot(0.5 * body.length_m, body.radius_m);
        case BodyShape::Torus:
            return body.radius_m + body.tube_radius_m;
        case BodyShape::Ellipsoid:
            return std::max({body.radii_m.x, body.radii_m.y, body.radii_m.z});
        case BodyShape::Disk:
            return std::hypot(0.5 * body.thickness_m, body.radius_m);
        case BodyShape::Paddle:
            return 0.5 * glm::length(body.blade_m) + body.handle_length_m + body.handle_radius_m;
        case BodyShape::Tetrahedron:
            return std::sqrt(0.375) * body.edge_m;
        case BodyShape::Mesh:
            break;
    }
    return std::numeric_limits<double>::infinity();
}

class BodyCheck {
  public:
    BodyCheck(SceneRules& rules, std::size_t i)
        : rules_(rules), body_(rules.scene.bodies[i]), path_(item("body", i)) {}

    void run() {
        rules_.name_is_usable(path_, body_.name);
        if (!rules_.blamed(path_ + ".shape")) {
            sizes_fit_the_shape();
            turning_would_show();
        }
        if (!rules_.blamed(path_ + ".motion")) {
            keys_fit_the_motion();
            is_in_the_tank();
        }
        axes_have_a_direction();
        oscillation_does_something();
        rules_.file_exists(path_ + ".path_csv", body_.path_csv);
        rules_.file_exists(path_ + ".file", body_.file);
    }

  private:
    void blame(std::string_view key, const std::string& message) {
        rules_.blame(fmt::format("{}.{}", path_, key), message);
    }
    bool given(std::string_view key) const { return rules_.given(fmt::format("{}.{}", path_, key)); }

    void sizes_fit_the_shape() {
        const std::string shape = fmt::format("shape = {}", in_quotes(to_word(body_.shape)));
        for (const SizeKey& size : kSizeKeys) {
            const bool belongs = belongs_to(size, body_.shape);
            if (belongs && !size.optional && !given(size.key))
                blame(size.key,
                      fmt::format("is missing here: {} needs {} = {}", shape, size.key, size.holds));
            if (!belongs && given(size.key))
                blame(size.key, fmt::format("is not for {}, which has {}", shape, sizes_of(body_.shape)));
        }
        if (body_.shape == BodyShape::Torus && given("radius_m") && body_.tube_radius_m >= body_.radius_m)
            blame("tube_radius_m",
                  fmt::format("must be less than radius_m = {}, or the ring has no hole", body_.radius_m));
    }

    void turning_would_show() {
        if (body_.turning && body_.shape == BodyShape::Sphere)
            blame("turning", "is for shapes that are not round: a sphere looks the same however it turns");
    }

    // Zeros are harmless, and print_scene() writes them.
    void keys_fit_the_motion() {
        const std::string motion = fmt::format("motion is {}", in_quotes(to_word(body_.motion)));
        const auto only = [&](BodyMotion owner, std::string_view key, bool used) {
            if (used && body_.motion != owner)
                blame(key, fmt::format("is for motion = {}, but {}", in_quotes(to_word(owner)), motion));
        };
        only(BodyMotion::Prescribed, "velocity_m_s", body_.velocity_m_s != glm::dvec3(0.0));
        only(BodyMotion::Prescribed, "acceleration_m_s2", body_.acceleration_m_s2 != glm::dvec3(0.0));
        only(BodyMotion::Prescribed, "spin_rad_s", body_.spin_rad_s != glm::dvec3(0.0));
        only(BodyMotion::Prescribed, "path_csv", !body_.path_csv.empty());
        only(BodyMotion::Prescribed, "start_s", body_.start_s != 0.0);
        only(BodyMotion::Prescribed, "oscillation", body_.oscillation.has_value());
        only(BodyMotion::Held, "turning", body_.turning);
        if (body_.density_kg_m3 && body_.motion != BodyMotion::Free && !body_.turning)
            blame("density_kg_m3", "is for motion = \"free\" and for turning = true, but " + motion);
        if (body_.motion == BodyMotion::Free && !given("density_kg_m3"))
            blame("density_kg_m3", "is missing here: motion = \"free\" needs density_kg_m3 = a number");
        if (body_.inside_out && body_.motion != BodyMotion::Fixed && body_.motion != BodyMotion::Prescribed)
            blame("inside_out", "a container is \"fixed\" or \"prescribed\", but " + motion);
    }

    void is_in_the_tank() {
        if (body_.motion == BodyMotion::Held) return;
        if (!given("centre_m"))
            return blame("centre_m", "is missing here: write centre_m = a list of 3 numbers");
        if (body_.inside_out) return;
        if (body_.motion == BodyMotion::Fixed)
            rules_.reaches_the_tank(path_, "centre_m", body_.centre_m, reach_m(body_));
        if (body_.motion == BodyMotion::Free) rules_.reaches_the_tank(path_, "centre_m", body_.centre_m, 0.0);
    }

    void axes_have_a_direction() {
        if (!(glm::length(body_.axis) > 0.0)) blame("axis", kNoDirection);
        if (body_.oscillation && !(glm::length(body_.oscillation->axis) > 0.0))
            blame("oscillation.axis", kNoDirection);
    }

    void oscillation_does_something() {
        if (!body_.oscillation) return;
        if (body_.oscillation->amplitude_m == glm::dvec3(0.0) && body_.oscillation->angle_deg == 0.0)
            blame("oscillation", "does nothing: give it amplitude_m, angle_deg or both");
        if (body_.oscillation->angle_deg != 0.0 && body_.spin_rad_s != glm::dvec3(0.0))
            blame("oscillation.angle_deg", "a body with spin_rad_s turns already; remove one of them");
    }

    static constexpr const char* kNoDirection =
        "[0, 0, 0] is no direction; [0, 0, 1] points towards the visitor";

    SceneRules& rules_;
    const Scene::Body& body_;
    const std::string path_;
};

}  // namespace

void check_bodies(SceneRules& rules) {
    std::size_t held = 0;
    for (std::size_t i = 0; i < rules.scene.bodies.size(); ++i) {
        BodyCheck(rules, i).run();
        if (rules.scene.bodies[i].motion == BodyMotion::Held && held++ > 0)
            rules.blame(item("body", i) + ".motion",
                        "a second held body: the visitor has one hand on the handle");
    }
}

}  // namespace eddy
