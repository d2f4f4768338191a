#include "firmware/stability/fuzz.h"

#include "firmware/text_file.h"
#include "tests/gles/gl_fixture.h"
#include "tests/scratch_folder.h"

namespace eddy::stability {
namespace {

using FuzzTest = gles::GlTest;

TEST_F(FuzzTest, FiftyRandomScenesKeepTheRule) {
    const ScratchFolder folder;
    for (const FuzzFinding& finding : fuzz(gpu, {.folder = folder.path()}))
        ADD_FAILURE() << "seed " << finding.seed << ": " << finding.violation << "\n"
                      << read_text_file(finding.file);
}

// A formula without a value at one place: nothing but a broken rule can be said of it.
constexpr const char* kBroken = R"toml(
[tank]
size_m = [0.16, 0.16, 0.16]
cells = [16, 16, 16]
[smoke]
initial = "1 / (x - 0.085)"
[[source]]
centre_m = [0.08, 0.08, 0.08]
radius_m = 0.02
smoke_per_s = 1.0
)toml";

TEST_F(FuzzTest, SeesASceneThatIsBroken) {
    EXPECT_NE(first_violation(gpu, read_scene(kBroken, "s.toml").scene, 3).reason, "");
}

}  // namespace
}  // namespace eddy::stability
