#include "firmware/exhibit/config_memory.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

constexpr const char* kMeshScene = R"(title = "a mesh"
[tank]
size_m = [0.16, 0.16, 0.16]
cells = [16, 16, 16]
[[body]]
shape = "mesh"
file = "../meshes/ball.obj"
centre_m = [0.08, 0.08, 0.08]
)";

class Memory : public testing::Test {
  protected:
    Memory() {
        for (const char* folder : {"eddy", "eddy/scenes", "eddy/meshes", "state"})
            std::filesystem::create_directory(scratch_.path() / folder);
    }
    ConfigMemory memory(const std::string& boot = "1", const std::string& program = "1.0") const {
        return {scratch_.path() / "state/config", boot, program};
    }
    ConfigSet read() const { return read_config_set(scratch_.path() / "eddy", {}); }
    ConfigSet read(const std::string& text) const {
        scratch_.write("eddy/exhibit.toml", text);
        return read();
    }

    const ScratchFolder scratch_;
};

TEST_F(Memory, HasTheLastGoodOneWithAllThatItNames) {
    scratch_.write("eddy/scenes/hall.toml", kMeshScene);
    scratch_.write("eddy/meshes/ball.obj", "v 0 0 0\n");
    const ConfigSet set = read("scene = \"scenes/hall.toml\"\nmax_force_n = 2\n");
    ASSERT_TRUE(set.good()) << to_string(set.diagnostics.front());
    EXPECT_EQ(set.files.refers.size(), 1u);
    memory().keep_as_last_good(set);
    std::filesystem::remove_all(scratch_.path() / "eddy");

    ConfigMemory later = memory("2");
    const auto kept = later.last_good({});
    ASSERT_TRUE(kept);
    EXPECT_EQ(later.unreadable(), 0);
    EXPECT_EQ(kept->hash, set.hash);
    EXPECT_EQ(kept->exhibit.exhibit, set.exhibit.exhibit);
    EXPECT_EQ(kept->scene.scene.title, "a mesh");
    EXPECT_EQ(read_all(kept->scene.scene.bodies.at(0).file), "v 0 0 0\n");
    EXPECT_EQ(kept->scene.scene.bodies.at(0).file.extension(), ".obj");
}

TEST_F(Memory, NoticesACopyThatIsNotWhatItWas) {
    scratch_.write("eddy/scenes/hall.toml", kMeshScene);
    scratch_.write("eddy/meshes/ball.obj", "v 0 0 0\n");
    memory().keep_as_last_good(read("scene = \"scenes/hall.toml\"\n"));
    for (const auto& copy : std::filesystem::directory_iterator(scratch_.path() / "state/config/files"))
        std::ofstream(copy.path()) << "v 1 0 0\n";
    ConfigMemory later = memory("2");
    EXPECT_FALSE(later.last_good({}));
    EXPECT_EQ(later.unreadable(), 1);
}

TEST_F(Memory, DropsCopiesThatNothingNames) {
    scratch_.write("eddy/scenes/hall.toml", kMeshScene);
    scratch_.write("eddy/meshes/ball.obj", "v 0 0 0\n");
    ConfigMemory one = memory();
    one.keep_as_last_good(read("scene = \"scenes/hall.toml\"\n"));
    scratch_.write("eddy/meshes/ball.obj", "v 1 1 1\n");
    one.keep_as_last_good(read());
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch_.path() / "state/config/files"), {}),
              1);
    EXPECT_TRUE(memory("2").last_good({}));
}

TEST_F(Memory, BlackListsWhatTheProgramDiedUnder) {
    memory().begin_probation("bad");
    ConfigMemory later = memory();
    EXPECT_EQ(later.judge(), "bad");
    EXPECT_TRUE(later.black_listed("bad"));
    EXPECT_FALSE(later.black_listed("good"));
    ConfigMemory still = memory("2");
    EXPECT_EQ(still.judge(), std::nullopt) << "once is enough";
    EXPECT_TRUE(still.black_listed("bad"));
}

TEST_F(Memory, GivesWhatTheProgramDiedUnderAChanceWithAnotherProgram) {
    memory().begin_probation("bad");
    EXPECT_EQ(memory().judge(), "bad");
    ConfigMemory updated = memory("2", "1.1");
    EXPECT_EQ(updated.judge(), std::nullopt);
    EXPECT_FALSE(updated.black_listed("bad"));
    updated.begin_probation("bad");
    EXPECT_EQ(memory("2", "1.1").judge(), "bad");
    ConfigMemory back = memory("3", "1.0");
    back.judge();
    EXPECT_TRUE(back.black_listed("bad")) << "and that one has not forgotten";
}

TEST_F(Memory, ReadsABlackListFromBeforeProgramsWereToldApart) {
    StateFile(scratch_.path() / "state/config/black-list").write("[\"bad\",\"worse\"]");
    ConfigMemory updated = memory();
    EXPECT_EQ(updated.judge(), std::nullopt);
    EXPECT_EQ(updated.unreadable(), 0);
    EXPECT_FALSE(updated.black_listed("bad")) << "another program died under it";
    updated.begin_probation("bad");
    ConfigMemory later = memory();
    EXPECT_EQ(later.judge(), "bad");
    EXPECT_TRUE(later.black_listed("bad"));
    EXPECT_EQ(later.unreadable(), 0);
}

TEST_F(Memory, ForgivesPowerCutsButNotThreeInARow) {
    memory("1").begin_probation("new");
    ConfigMemory second = memory("2");
    EXPECT_EQ(second.judge(), std::nullopt);
    second.begin_probation("new");
    ConfigMemory third = memory("3");
    EXPECT_EQ(third.judge(), std::nullopt);
    third.begin_probation("new");
    EXPECT_EQ(memory("4").judge(), "new");
}

TEST_F(Memory, CountsTheCutsThatAnotherProgramSawAsNone) {
    memory("1").begin_probation("new");
    for (const char* boot : {"2", "3"}) EXPECT_EQ(memory(boot).judge(), std::nullopt);
    ConfigMemory updated = memory("4", "1.1");
    EXPECT_EQ(updated.judge(), std::nullopt) << "it never ran them";
    EXPECT_FALSE(updated.black_listed("new"));
    updated.begin_probation("new");
    for (const char* boot : {"5", "6"}) EXPECT_EQ(memory(boot, "1.1").judge(), std::nullopt);
    EXPECT_EQ(memory("7", "1.1").judge(), "new");
}

TEST_F(Memory, ReadsAProbationFromBeforeProgramsWereToldApart) {
    StateFile(scratch_.path() / "state/config/probation").write(R"({"hash":"new","boot":"1","cuts":2})");
    ConfigMemory updated = memory("2");
    EXPECT_EQ(updated.judge(), std::nullopt);
    EXPECT_EQ(updated.unreadable(), 0);
    EXPECT_EQ(updated.on_probation(), "") << "of another program";
    EXPECT_EQ(memory("3").judge(), std::nullopt);
}

TEST_F(Memory, ForgetsAProbationThatEnded) {
    ConfigMemory one = memory();
    one.begin_probation("good");
    one.end_probation();
    EXPECT_EQ(memory().judge(), std::nullopt);
    EXPECT_EQ(one.failed_writes(), 0);
}

TEST_F(Memory, ThatCannotBeWrittenStopsNothing) {
    scratch_.write("state/config", "a file where the folder should be");
    ConfigMemory one = memory();
    EXPECT_EQ(one.judge(), std::nullopt);
    one.begin_probation("new");
    one.keep_as_last_good(read("max_force_n = 1\n"));
    EXPECT_EQ(one.failed_writes(), 2);
    EXPECT_NE(one.trouble(), "");
    ConfigMemory none("", "1", "1.0");
    none.begin_probation("new");
    EXPECT_EQ(none.failed_writes(), 0);
}

TEST_F(Memory, HashesTellEveryFileApart) {
    const std::string one = read("max_force_n = 1\n").hash, two = read("max_force_n = 2\n").hash;
    EXPECT_NE(one, two);
    EXPECT_EQ(read("max_force_n = 1\n").hash, one);
    std::filesystem::create_directory(scratch_.path() / "eddy/conf.d");
    scratch_.write("eddy/conf.d/10.toml", "max_force_n = 1\n");
    EXPECT_NE(read().hash, one);
    std::filesystem::remove(scratch_.path() / "eddy/conf.d/10.toml");
    scratch_.write("eddy/scenes/hall.toml", kMeshScene);
    scratch_.write("eddy/meshes/ball.obj", "v 0 0 0\n");
    const std::string scene = read("scene = \"scenes/hall.toml\"\n").hash;
    scratch_.write("eddy/meshes/ball.obj", "v 0 0 1\n");
    EXPECT_NE(read().hash, scene);
}

}  // namespace
}  // namespace eddy
