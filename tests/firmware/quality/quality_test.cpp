#include "firmware/quality/quality.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "firmware/fluid_setup.h"

namespace eddy {
namespace {

constexpr SolverPreset kPresets[] = {SolverPreset::Fast, SolverPreset::Precise, SolverPreset::Yang2009};

TEST(Quality, UsualIterationsAreThoseAFluidTakes) {
    for (const SolverPreset preset : kPresets) {
        Scene scene = load_scene("validation/B2-shell").scene;
        scene.solver = {};
        scene.solver.preset = preset;
        const gles::SolverSetup solver = fluid_setup(scene).solver;
        EXPECT_EQ(usual_iterations(preset),
                  preset == SolverPreset::Yang2009 ? solver.jacobi_sweeps : solver.cycles);
    }
}

TEST(Quality, IsDescribedInWords) {
    EXPECT_EQ(describe(Quality{SolverPreset::Fast, 64, 2}), "fast 64^3, 2 cycles");
    EXPECT_EQ(describe(Quality{SolverPreset::Precise, 16, 1}), "precise 16^3, 1 cycle");
    EXPECT_EQ(describe(Quality{SolverPreset::Yang2009, 25, 40}), "yang2009 25^3, 40 sweeps");
}

TEST(Quality, PresetIsFoundByItsNameAlone) {
    for (const SolverPreset preset : kPresets) EXPECT_EQ(preset_named(std::string(to_word(preset))), preset);
    EXPECT_THROW(preset_named("fest"), std::invalid_argument);
}

}  // namespace
}  // namespace eddy
