#include "firmware/haptic_study/study.h"

#include <fmt/format.h>

#include <cmath>

#include "firmware/haptic/stability_limits.h"
#include "firmware/input_error.h"
#include "firmware/scene_grid.h"

namespace eddy::haptic_study {
namespace {

/// Without a body in the hand nothing is felt.
Scene scene_of(const std::string& name, int cells) {
    const Scene scene = with_longest_side(load_scene(name).scene, cells, kGridOption);
    if (!BodySchedule(scene).held())
        throw InputError(fmt::format("--scene {}: there is nothing in it that a hand holds", name));
    return scene;
}

/// Of kLetGoHz, what is tried in every scene: the slowest, and a brisk one.
constexpr double kSceneLetGoHz[] = {1.0, 3.0};

KnownFluid::Settings as_steep_as_allowed(double rate_hz) {
    return {.drag_ns_m = most_drag_ns_m(Seconds(1.0 / rate_hz)), .added_kg = kMostAddedKg};
}

void study_known(Study& study) {
    KnownFluid exact(kKnownFluid);
    const std::vector<glm::dvec3> reference = reference_forces(exact);
    for (const ForceLaw law : kLaws) {
        for (const double rate_hz : {20.0, 30.0, 50.0, 75.0, 1000.0}) {
            KnownFluid fluid(kKnownFluid);
            study.circles.push_back({kKnown, law, rate_hz, circle_figures(fluid, law, rate_hz, reference)});
        }
        for (const double rate_hz : kRatesHz) {
            for (const double stir_hz : kStirsHz) {
                KnownFluid fluid(kKnownFluid);
                study.stirs.push_back(
                    {kKnown, law, rate_hz, stir_hz, stir_figures(fluid, law, rate_hz, stir_hz)});
            }
            const auto swing = [&](Holder holder, double stir_hz) {
                KnownFluid fluid(as_steep_as_allowed(rate_hz));
                study.swings.push_back({kKnown, law, rate_hz, holder, stir_hz,
                                        swing_figures(coming_to_rest(fluid, law, rate_hz, holder, stir_hz))});
            };
            for (const Holder holder : {Holder::Arm, Holder::StiffArm}) swing(holder, 1.0);
            for (const double stir_hz : kLetGoHz) swing(Holder::LetsGo, stir_hz);
        }
    }
    for (const double rate_hz : kRatesHz) {
        KnownFluid::Settings jet = kKnownFluid;
        jet.push_n = {0.8, 0.0, 0.0};
        KnownFluid fluid(jet);
        study.pulls.push_back({kKnown, rate_hz, pull_error(fluid, rate_hz)});
    }
}

/// One scene; each of its trials begins at its start.
class SceneStudy {
  public:
    SceneStudy(gles::Gpu& gpu, const std::string& name, const Scene& scene, Study& study,
               std::function<void(double, const std::string&)> done)
        : gpu_(gpu), name_(name), scene_(scene), study_(study), done_(std::move(done)) {
        HapticExchange exchange;
        slopes_ = Show(gpu, scene, exchange).slopes();
        const double at_handle = scene.haptics.gain * scene.haptics.workspace_scale;
        FluidRow row{
            name, scene.haptics.gain, at_handle * slopes_.drag_ns_m, at_handle * slopes_.added_kg, {}};
        for (const double rate_hz : kRatesHz) row.gains.push_back(at(rate_hz)->orders().gain);
        study.fluids.push_back(row);
    }

    void circles() {
        done_(0.0, "the fluid at 1 kHz");
        const std::vector<glm::dvec3> reference = reference_forces(*at(1000.0));
        done_(2.5 * 1000.0, "the fluid at 1 kHz");
        for (const double rate_hz : kRatesHz)
            for (const ForceLaw law : kLaws) {
                study_.circles.push_back(
                    {name_, law, rate_hz, circle_figures(*at(rate_hz), law, rate_hz, reference)});
                done_(3.5 * rate_hz, "circles");
            }
    }
    void stirs() {
        for (const double rate_hz : {20.0, 50.0})
            for (const double stir_hz : kStirsHz)
                for (const ForceLaw law : kLaws) {
                    study_.stirs.push_back(
                        {name_, law, rate_hz, stir_hz, stir_figures(*at(rate_hz), law, rate_hz, stir_hz)});
                    done_(4.0 * rate_hz, "energy of a cycle");
                }
    }
    void swings() {
        for (const double rate_hz : kRatesHz) {
            std::vector<Felt> fixed;
            const auto swing = [&](Holder holder, double stir_hz) {
                const std::vector<Felt> ticks =
                    coming_to_rest(*at(rate_hz), ForceLaw::Model, rate_hz, holder, stir_hz);
                if (holder == Holder::Fixed) fixed = ticks;
                SwingRow row{name_,
                             ForceLaw::Model,
                             rate_hz,
                             holder,
                             stir_hz,
                             swing_figures(ticks),
                             carried_figures(fixed, holder)};
                // Where a jet has carried it, or an arm gave way, the flow may shake it more than in the middle.
                if (!rests(row.swing, row.carried))
                    row.carried =
                        carried_figures(fixed_there(*at(rate_hz), ForceLaw::Model, rate_hz, ticks), holder);
                study_.swings.push_back(row);
                done_((holder == Holder::LetsGo ? 7.0 : 3.9) * rate_hz, "whether the handle comes to rest");
            };
            for (const Holder holder : {Holder::Fixed, Holder::Arm, Holder::StiffArm}) swing(holder, 1.0);
            for (const double stir_hz : kSceneLetGoHz) swing(Holder::LetsGo, stir_hz);
        }
    }
    void pulls() {
        for (const double rate_hz : kRatesHz) {
            study_.pulls.push_back({name_, rate_hz, pull_error(*at(rate_hz), rate_hz)});
            done_(4.0 * rate_hz, "the pull of a jet");
        }
    }
    static constexpr double kCircles = 2500.0 + 7.0 * 175.0, kStirs = 4.0 * 70.0 * 8.0,
                            kSwings = (3.0 * 3.9 + 2.0 * 7.0) * 175.0, kPulls = 4.0 * 175.0;  ///< steps

  private:
    std::unique_ptr<SceneFluid> at(double rate_hz) const {
        return std::make_unique<SceneFluid>(gpu_, scene_, slopes_, Seconds(1.0 / rate_hz));
    }

    gles::Gpu& gpu_;
    std::string name_;
    Scene scene_;
    FluidSlopes slopes_;
    Study& study_;
    std::function<void(double, const std::string&)> done_;
};

bool blows(const Scene& scene) {
    for (const Scene::Source& source : scene.sources)
        if (source.velocity_m_s) return true;
    return false;
}

}  // namespace

const char* to_string(ForceLaw law) {
    return law == ForceLaw::Filter ? "filter" : "model";
}

std::string held_how(const SwingRow& row) {
    const char* holder = to_string(row.holder);
    return row.holder == Holder::LetsGo ? fmt::format("{} at {:g} Hz", holder, row.stir_hz) : holder;
}

Study study(gles::Gpu* gpu, const StudyOrder& order,
            const std::function<void(double, double, const std::string&)>& progress) {
    std::vector<Scene> scenes;
    double total = 0.0, done = 0.0;
    for (const std::string& name : order.scenes) {
        scenes.push_back(scene_of(name, order.cells));
        total += SceneStudy::kCircles + SceneStudy::kSwings;
        total += blows(scenes.back()) ? SceneStudy::kPulls : SceneStudy::kStirs;
    }
    Study all;
    study_known(all);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        SceneStudy one(*gpu, order.scenes[i], scenes[i], all, [&](double steps, const std::string& what) {
            progress(done += steps, total, order.scenes[i] + ", " + what);
        });
        one.circles();
        if (blows(scenes[i]))
            one.pulls();
        else
            one.stirs();
        one.swings();
    }
    return all;
}

}  // namespace eddy::haptic_study
