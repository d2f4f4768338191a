#include <algorithm>
#include <cmath>

#include "firmware/accuracy/case.h"
#include "gles/grid_io.h"

// A15  A ball of smoke in a flow that is given, draws it out and brings it back (LeVeque 1996, SIAM J. Numer. Anal. 33; Enright,
//      Fedkiw, Ferziger, Mitchell 2002): what the transport alone makes of it. At the turn its sheet is thinner than a cell
//      of all these grids, and much is lost; so the flow is also turned back earlier.

namespace eddy::accuracy {
namespace {

std::vector<double> smoke(const Run& run) {
    const gles::Field<gles::Cells>& field = *run.fluid().smoke();
    const std::vector<float> s = gles::unpack_scalars(field.texture().download(), field.layout());
    return {s.begin(), s.end()};
}

std::vector<double> there_and_back(Laboratory& lab) {
    Run run = lab.start();
    const std::vector<double> before = smoke(run);
    run.step_to_end();
    const std::vector<double> after = smoke(run);
    struct Ball {
        double mass = 0.0, volume = 0.0;  // sum of s, and how many cells have more than half
        void add(double s) {
            mass += s;
            volume += s > 0.5 ? 1.0 : 0.0;
        }
    } was, is;
    double displaced = 0.0, beyond = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        was.add(before[i]);
        is.add(after[i]);
        displaced += std::abs(after[i] - before[i]);
        const double out = std::max(-after[i], after[i] - 1.0);
        if (!(out <= beyond)) beyond = out;  // what is not a number is out
    }
    return {displaced / was.mass, is.mass / was.mass - 1.0, is.volume / was.volume - 1.0, beyond};
}

Case drawn_out(const std::string& name, const std::string& title, const std::string& scene,
               std::vector<std::string> set) {
    return {
        .name = name,
        .title = title,
        .scene = scene,
        .set = std::move(set),
        .time_step = TimeStep::Courant,
        .quick = {16, 32},
        .full = {16, 32, 64, 128},
        .quantities =
            {{.name = "sum |s - s_0| / sum s_0", .source = "the flow brings all smoke back to where it was"},
             {.name = "M / M_0 - 1", .source = "conservation of smoke"},
             {.name = "V / V_0 - 1", .source = "volume in which s > 1/2"},
             {.name = "beyond 0 and 1", .source = "transport makes no new extremes", .limits = {{16, 0.0}}}},
        .measure = there_and_back};
}

/// The same with the displacement judged.
Case drawn_out_a_little(Case one, const std::vector<Limit>& displaced) {
    one.quick = {16, 32, 64};
    one.quantities[0].limits = displaced;
    one.quantities[0].least_order = 0.15;
    return one;
}

}  // namespace

std::vector<Case> deformation_cases() {
    const std::vector<std::string> semi_lagrangian{"solver.advection=\"semi_lagrangian\""};
    const std::string far = "validation/A15", near = "validation/A15-short";
    return {
        drawn_out("A15-maccormack", "a ball of smoke drawn out for 1.5 s and brought back, MacCormack", far,
                  {}),
        drawn_out("A15-semi", "the same, semi-Lagrangian", far, semi_lagrangian),
        drawn_out_a_little(drawn_out("A15-short-maccormack", "drawn out for 0.5 s, MacCormack", near, {}),
                           {{16, 0.95}, {32, 0.65}, {64, 0.42}}),
        drawn_out_a_little(drawn_out("A15-short-semi", "the same, semi-Lagrangian", near, semi_lagrangian),
                           {{16, 1.2}, {32, 1.0}, {64, 0.8}})};
}

}  // namespace eddy::accuracy
