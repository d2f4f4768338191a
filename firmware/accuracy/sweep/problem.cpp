#include "firmware/accuracy/sweep/problem.h"

#include <fmt/format.h>

#include <cmath>

#include "config/diagnostic.h"
#include "config/nearest.h"
#include "firmware/accuracy/convergence.h"
#include "firmware/accuracy/set_off.h"
#include "firmware/accuracy/study.h"
#include "firmware/input_error.h"

namespace eddy::accuracy::sweep {
namespace {

/// The shipped case of this name, with time steps as it has them.
const Case& shipped(const std::string& name) {
    return *cases_named(name).at(0);
}

/// The greatest error of these quantities of a shipped case.
double worst_of(const Case& one, Laboratory& lab, std::initializer_list<std::size_t> quantities) {
    const std::vector<double> measured = one.measure(lab);
    double worst = 0.0;
    for (const std::size_t q : quantities)
        worst = worse(worst, error_of(one.quantities.at(q), measured.at(q)));
    return worst;
}

SetOff::ForceOn way_to_force(ForceWay way) {
    switch (way) {
        case ForceWay::Surface:
            return SetOff::on_surface;
        case ForceWay::Box:
            return [](const gles::Fluid& fluid, const gles::StepResult&) {
                return fluid.force_methods().at(0).box_n;
            };
        case ForceWay::Impulse:
            return [](const gles::Fluid& fluid, const gles::StepResult&) {
                return fluid.force_methods().at(0).impulse_n;
            };
    }
    throw std::logic_error("a way without a force");
}

double set_off(Laboratory& lab, const Setting& setting) {
    double worst = 0.0;
    for (int place = 0; place < SetOff::kPlaces; ++place) {
        SetOff ball(lab.gpu(), lab.scene(), place, way_to_force(setting.force));
        while (!ball.done()) ball.step();
        worst = worse(worst, ball.error());
    }
    return worst;
}

}  // namespace

const std::vector<Problem>& all_problems() {
    static const std::vector<Problem> problems{
        {.name = "B2",
         .plain = "a sudden start",
         .title = "A ball at rest, radius L/10, speeds up in water: force in the second to fourth step of "
                  "that, worst of 4 "
                  "places in a cell.",
         .picture = "work_B2",
         .error = "force",
         .of = shipped("B2-box"),
         .quick = {24, 32, 48, 64},
         .full = {16, 24, 32, 48, 64, 96, 128},
         .thresholds =
             {{0.10, "10 %"}, {kForceJnd, "7 % (hand)"}, {0.05, "5 %"}, {0.02, "2 %"}, {0.01, "1 %"}},
         .hand = kForceJnd,
         .measure = set_off},
        {.name = "B3",
         .plain = "a steady pull through glycerine",
         .title = "A ball, radius L/5, is drawn through glycerine: steady drag, worse of 2 places in a cell.",
         .picture = "work_B3",
         .error = "force",
         .of = shipped("B3"),
         .quick = {20, 32, 48},
         .full = {16, 20, 25, 32, 48, 64},
         .thresholds = {{kViscosityJnd, "19 % (hand)"},
                        {0.10, "10 %"},
                        {kForceJnd, "7 %"},
                        {0.05, "5 %"},
                        {0.02, "2 %"},
                        {0.01, "1 %"}},
         .hand = kViscosityJnd,
         .measure =
             [](Laboratory& lab, const Setting&) {
                 return worst_of(shipped("B3"), lab, {0, 1});
             }},
        {.name = "B8.7",
         .plain = "does the force tremble",
         .title = "A ball glides through water: trembling of its drag coefficient over the cells.",
         .picture = "ripple",
         .error = "drag coefficient, rms",
         .of = shipped("B8.7-precise"),
         .quick = {48},
         .full = {48, 72, 96},
         .measure = [](Laboratory& lab,
                       const Setting&) { return worst_of(shipped("B8.7-precise"), lab, {0}); }},
        {.name = "A1",
         .plain = "how long eddies live",
         .title = "Vortices of Taylor and Green at Re 10 die away too fast: numerical over true viscosity.",
         .picture = "viscosity",
         .error = "viscosity",
         .of = shipped("A1-courant"),
         .quick = {16, 32, 64},
         .full = {16, 32, 64, 128},
         .measure = [](Laboratory& lab, const Setting&) {
             return worst_of(shipped("A1-courant"), lab, {1});
         }}};
    return problems;
}

const Problem& problem_named(const std::string& name) {
    std::vector<std::string_view> names;
    for (const Problem& problem : all_problems()) {
        if (problem.name == name) return problem;
        names.push_back(problem.name);
    }
    throw InputError(fmt::format("--case {}: there is no such case in a sweep; nearest first: {}",
                                 in_quotes(name), listed(nearest_first(name, names))));
}

}  // namespace eddy::accuracy::sweep
