#include <fmt/format.h>

#include <algorithm>

#include "config/scene_rules.h"

namespace eddy {
namespace {

class FlowCheck {
  public:
    explicit FlowCheck(SceneRules& rules) : rules_(rules), scene_(rules.scene) {}

    void cells_are_cubes() {
        if (rules_.blamed("tank.size_m") || rules_.blamed("tank.cells")) return;
        const glm::dvec3 size = scene_.tank.size_m;
        const glm::dvec3 cells(scene_.tank.cells);
        const glm::dvec3 width = size / cells;
        const double widest = std::max({width.x, width.y, width.z});
        const double narrowest = std::min({width.x, width.y, width.z});
        if (widest - narrowest <= 1e-4 * narrowest) return;
        // The cube that changes size_m least, in the sense of least squares.
        const double cube = glm::dot(size, cells) / glm::dot(cells, cells);
        rules_.blame(
            rules_.given("tank.size_m") ? "tank.size_m" : "tank.cells",
            fmt::format("cells must be cubes, but are {:.6g} x {:.6g} x {:.6g} m; nearest size_m that is "
                        "right: [{:.6g}, {:.6g}, {:.6g}]",
                        width.x, width.y, width.z, cube * cells.x, cube * cells.y, cube * cells.z));
    }

    void effects_have_what_they_need() {
        const bool weightless =
            scene_.fluid.gravity_m_s2 == glm::dvec3(0.0) && !rules_.blamed("fluid.gravity_m_s2");
        const std::string needs_gravity =
            "does nothing without gravity: give fluid.gravity_m_s2, or remove this key";
        if (scene_.smoke && scene_.smoke->weight != 0.0 && weightless)
            rules_.blame("smoke.weight", needs_gravity);
        if (scene_.temperature && scene_.temperature->expansion_1_k != 0.0 && weightless)
            rules_.blame("temperature.expansion_1_k", needs_gravity);
        rules_.file_exists("initial.velocity_npy", scene_.initial.velocity_npy);
        if (!scene_.initial.velocity_npy.empty() && scene_.initial.velocity_m_s != FormulaVector{})
            rules_.blame("initial.velocity_npy", "takes the place of velocity_m_s: remove one of them");
    }

    void source_makes_sense(std::size_t i) {
        const Scene::Source& source = scene_.sources[i];
        const std::string path = item("source", i);
        rules_.name_is_usable(path, source.name);
        if (source.smoke_per_s && !scene_.smoke)
            rules_.blame(path + ".smoke_per_s",
                         "needs the smoke effect: add a table [smoke], or remove this key");
        if (source.temperature_k_per_s && !scene_.temperature)
            rules_.blame(path + ".temperature_k_per_s",
                         "needs the temperature effect: add a table [temperature], or remove this key");
        if (!rules_.given(path + ".smoke_per_s") && !rules_.given(path + ".velocity_m_s") &&
            !rules_.given(path + ".temperature_k_per_s"))
            rules_.blame(path, "does nothing: give it smoke_per_s, temperature_k_per_s or velocity_m_s");
        if (source.stop_s && *source.stop_s <= source.start_s && !rules_.blamed(path + ".start_s"))
            rules_.blame(path + ".stop_s", fmt::format("must be after start_s = {}", source.start_s));
        rules_.reaches_the_tank(path, "centre_m", source.centre_m, source.radius_m);
    }

    void an_imposed_flow_is_not_pushed() {
        if (!scene_.imposed) return;
        const auto idle = [&](const std::string& key, bool used) {
            if (used) rules_.blame(key, "does nothing in an imposed flow: remove this, or [imposed]");
        };
        idle("forcing", scene_.forcing.has_value());
        idle("vorticity_confinement", scene_.vorticity_confinement.has_value());
        idle("fluid.viscosity_pa_s", scene_.fluid.viscosity_pa_s != 0.0);
        idle("fluid.gravity_m_s2", scene_.fluid.gravity_m_s2 != glm::dvec3(0.0));
        idle("initial.velocity_m_s", scene_.initial.velocity_m_s != FormulaVector{});
        idle("initial.velocity_npy", !scene_.initial.velocity_npy.empty());
        idle("solver.cycles", scene_.solver.cycles.has_value());
        idle("solver.time_order", scene_.solver.time_order != 1);
        idle("tank.walls", scene_.tank.walls != Scene::Walls{});
        for (std::size_t i = 0; i < scene_.sources.size(); ++i)
            idle(item("source", i) + ".velocity_m_s", scene_.sources[i].velocity_m_s.has_value());
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) idle(item("body", i), true);
    }

    void solver_keys_fit_the_preset() {
        if (rules_.blamed("solver.preset")) return;
        const Scene::Solver& s = scene_.solver;
        const std::string preset = in_quotes(to_word(s.preset));
        const bool yang = s.preset == SolverPreset::Yang2009;
        const auto only_yang = [&](const char* key, bool used) {
            if (used && !yang) rules_.blame(key, "is for preset = \"yang2009\", but preset is " + preset);
        };
        const auto not_yang = [&](const char* key, bool used, const char* cure) {
            if (used && yang)
                rules_.blame(key, fmt::format("is not in the method of Yang et al. 2009: {}", cure));
        };
        only_yang("solver.jacobi_sweeps", s.jacobi_sweeps.has_value());
        only_yang("solver.force_sum", s.force_sum.has_value());
        not_yang("solver.cycles", s.cycles.has_value(), "use jacobi_sweeps");
        not_yang("solver.viscous_cycles", s.viscous_cycles.has_value(), "remove this key");
        not_yang("solver.advection", s.advection.has_value(), "it has its own; remove this key");
        not_yang("solver.time_order", s.time_order != 1, "it is of first order; remove this key");
        const char* another = "use preset = \"fast\" or \"precise\"";
        not_yang("fluid.gravity_m_s2", scene_.fluid.gravity_m_s2 != glm::dvec3(0.0), another);
        not_yang("vorticity_confinement", scene_.vorticity_confinement.has_value(), another);
        not_yang("forcing", scene_.forcing.has_value(), another);
        not_yang("imposed", scene_.imposed.has_value(), another);
        not_yang("temperature", scene_.temperature.has_value(), another);
        not_yang("smoke.initial", scene_.smoke && scene_.smoke->initial != Formula(), another);
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            not_yang((item("body", i) + ".motion").c_str(), scene_.bodies[i].motion == BodyMotion::Free,
                     another);
            not_yang((item("body", i) + ".turning").c_str(), scene_.bodies[i].turning, another);
        }
        for (const Scene::Wall* wall : scene_.tank.walls.all())
            if (wall->kind == WallKind::Inflow || wall->kind == WallKind::Open)
                return not_yang("tank.walls", true, another);
        if (s.viscous_cycles && scene_.fluid.viscosity_pa_s == 0.0 && !rules_.blamed("fluid.viscosity_pa_s"))
            rules_.blame("solver.viscous_cycles",
                         "does nothing in an inviscid fluid: give fluid.viscosity_pa_s, or remove this key");
    }

  private:
    SceneRules& rules_;
    const Scene& scene_;
};

}  // namespace

void check_flow(SceneRules& rules) {
    FlowCheck check(rules);
    check.cells_are_cubes();
    check.effects_have_what_they_need();
    for (std::size_t i = 0; i < rules.scene.sources.size(); ++i) check.source_makes_sense(i);
    check.an_imposed_flow_is_not_pushed();
    check.solver_keys_fit_the_preset();
}

}  // namespace eddy
