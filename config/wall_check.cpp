#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "config/scene_rules.h"

namespace eddy {
namespace {

struct Side {
    const char* name;
    const Scene::Wall& wall;
    int axis;
    bool high;
};

std::array<Side, 6> sides_of(const Scene::Walls& w) {
    return {{{"x_low", w.x_low, 0, false},
             {"x_high", w.x_high, 0, true},
             {"y_low", w.y_low, 1, false},
             {"y_high", w.y_high, 1, true},
             {"z_low", w.z_low, 2, false},
             {"z_high", w.z_high, 2, true}}};
}

// Volume that enters through a wall in a second, and the same with everything counted as entering [m3/s].
struct Flux {
    double net = 0.0;
    double gross = 0.0;
};

Flux flux_through(const Side& side, const glm::dvec3& size_m, double t_s) {
    constexpr int n = 24;  // samples along each edge
    const int a = (side.axis + 1) % 3, b = (side.axis + 2) % 3;
    const double area = size_m[a] * size_m[b] / (n * n);
    Flux flux;
    glm::dvec3 place_m(0.0);
    place_m[side.axis] = side.high ? size_m[side.axis] : 0.0;
    for (int i = 0; i < n * n; ++i) {
        place_m[a] = (i % n + 0.5) / n * size_m[a];
        place_m[b] = (i / n + 0.5) / n * size_m[b];
        const double speed = side.wall.velocity_m_s->evaluate(place_m, t_s)[side.axis];
        flux.net += (side.high ? -speed : speed) * area;
        flux.gross += std::abs(speed) * area;
    }
    return flux;
}

class WallCheck {
  public:
    explicit WallCheck(SceneRules& rules) : rules_(rules), scene_(rules.scene) {}

    void velocity_fits_the_kind() {
        for (const Side& side : sides_of(scene_.tank.walls)) {
            const std::string key = fmt::format("tank.walls.{}", side.name);
            const std::string velocity = key + ".velocity_m_s";
            if (rules_.blamed(key)) continue;
            const bool moves = side.wall.velocity_m_s.has_value();
            if (side.wall.kind == WallKind::Inflow && !moves)
                rules_.blame(velocity,
                             fmt::format("is missing here: write {} = {{ kind = \"inflow\", velocity_m_s = a "
                                         "list of 3 numbers or formulas }}",
                                         side.name));
            else if (moves && (side.wall.kind == WallKind::Slip || side.wall.kind == WallKind::Open))
                rules_.blame(velocity, fmt::format("is for no_slip and inflow, but kind is {}",
                                                   in_quotes(to_word(side.wall.kind))));
            else if (moves && side.wall.kind == WallKind::NoSlip && !slides_along_itself(side))
                rules_.blame(fmt::format("{}.{}", velocity, side.axis),
                             "must be 0: a no_slip wall moves along itself; for flow through it use inflow");
        }
    }

    void no_slip_needs_viscosity() {
        if (scene_.fluid.viscosity_pa_s > 0.0 || rules_.blamed("fluid.viscosity_pa_s")) return;
        for (const Side& side : sides_of(scene_.tank.walls)) {
            if (side.wall.kind != WallKind::NoSlip) continue;
            // One sentence, even when one word stands for all sides.
            return rules_.blame(
                fmt::format("tank.walls.{}", side.name),
                "an inviscid fluid does not stick to a wall: give fluid.viscosity_pa_s, or use "
                "\"slip\"");
        }
    }

    void what_flows_in_can_leave() {
        if (rules_.blamed("tank")) return;
        std::string first_inflow;
        std::array<Flux, 3> fluxes;  // at the beginning, in the middle and at the end
        for (const Side& side : sides_of(scene_.tank.walls)) {
            if (side.wall.kind == WallKind::Open) return;
            if (side.wall.kind != WallKind::Inflow) continue;
            if (first_inflow.empty()) first_inflow = fmt::format("tank.walls.{}", side.name);
            for (std::size_t i = 0; i < fluxes.size(); ++i) {
                const Flux flux = flux_through(side, scene_.tank.size_m,
                                               0.5 * static_cast<double>(i) * scene_.outputs.duration_s);
                fluxes[i].net += flux.net;
                fluxes[i].gross += flux.gross;
            }
        }
        const auto balanced = [](const Flux& flux) { return std::abs(flux.net) <= 0.01 * flux.gross; };
        if (!first_inflow.empty() && !std::all_of(fluxes.begin(), fluxes.end(), balanced))
            rules_.blame(first_inflow,
                         "what flows into a closed box cannot leave it: make a wall \"open\", or let as much "
                         "flow out through another inflow");
    }

  private:
    static bool slides_along_itself(const Side& side) {
        const FormulaVector& v = *side.wall.velocity_m_s;
        const Formula& through = side.axis == 0 ? v.x : side.axis == 1 ? v.y : v.z;
        return through.constant() == 0.0;
    }

    SceneRules& rules_;
    const Scene& scene_;
};

}  // namespace

void check_walls(SceneRules& rules) {
    WallCheck check(rules);
    check.velocity_fits_the_kind();
    check.no_slip_needs_viscosity();
    check.what_flows_in_can_leave();
}

}  // namespace eddy
