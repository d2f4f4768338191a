#include "firmware/accuracy/identity.h"

namespace eddy::accuracy {

Case at_both_presets(const Identity& identity) {
    Case one{.name = identity.name,
             .title = identity.title,
             .scene = identity.scene,
             .time_step = TimeStep::Courant,
             .quick = identity.quick,
             .full = identity.full};
    for (const char* preset : {"fast", "precise"})
        for (Quantity quantity : identity.quantities) {
            quantity.name += std::string(", ") + preset;
            one.quantities.push_back(quantity);
        }
    one.measure = [measure = identity.measure](Laboratory& lab) {
        std::vector<double> values;
        for (const SolverPreset preset : {SolverPreset::Fast, SolverPreset::Precise}) {
            Scene scene = lab.scene();
            scene.solver.preset = preset;
            for (const double value : measure(lab, scene)) values.push_back(value);
        }
        return values;
    };
    return one;
}

}  // namespace eddy::accuracy
