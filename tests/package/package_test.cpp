#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "config/exhibit.h"
#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// The machine's own settings, as a package installs them.
const fs::path kSettings = EDDY_PACKAGED_SETTINGS;

TEST(PackagedSettings, SetNothing) {
    const LoadedExhibit loaded = load_exhibit_file(kSettings);
    EXPECT_EQ(loaded.exhibit, Exhibit{});
    EXPECT_THAT(print_exhibit(loaded.exhibit, &loaded.origins), Not(HasSubstr(kSettings.string())));
}

TEST(PackagedSettings, SetEveryKeyToWhatItIsAnywayWithoutTheirHashes) {
    const ScratchFolder folder;
    const std::string text =
        std::regex_replace(read_all(kSettings), std::regex("\n#([a-z_0-9]+ *=)"), "\n$1");
    const LoadedExhibit loaded = load_exhibit_file(folder.write("exhibit.toml", text));
    EXPECT_EQ(loaded.exhibit, Exhibit{});
    const std::string printed = print_exhibit(loaded.exhibit, &loaded.origins);
    EXPECT_THAT(printed, Not(HasSubstr("# config/exhibit.toml"))) << "a key that the file does not name";
}

const std::string kOnACopy = EDDY_SOURCE_DIR "/tests/package/on_a_copy";

/// The package, if one was built from this very program.
class Package : public testing::Test {
  protected:
    void SetUp() override {
        std::error_code error;
        const auto built = fs::last_write_time(EDDY_PACKAGE, error);
        if (error) GTEST_SKIP() << "skipped: no package was built (script/package)";
        if (built < fs::last_write_time(EDDY_BINARY))
            GTEST_SKIP() << "skipped: the package is older than the program (script/package)";
        const Ended unpacked = Program({"dpkg-deb", "-R", EDDY_PACKAGE, folder_.path()}).wait();
        ASSERT_EQ(unpacked.status, 0) << unpacked.err;
    }
    std::string file(const std::string& name) { return read_all(folder_.path() / name); }
    ScratchFolder folder_;
};

TEST_F(Package, HoldsWhatAMachineNeedsToRunTheExhibit) {
    for (const char* name :
         {"usr/bin/eddy", "usr/lib/systemd/system/eddy.service", "usr/lib/systemd/system/eddy-poweroff.path",
          "usr/lib/systemd/system/eddy-poweroff.service", "usr/lib/sysusers.d/eddy.conf",
          "usr/lib/tmpfiles.d/eddy.conf", "usr/lib/udev/rules.d/60-eddy.rules", "etc/eddy/exhibit.toml",
          "usr/share/doc/eddy/README.md", "usr/share/doc/eddy/copyright"})
        EXPECT_TRUE(fs::is_regular_file(folder_.path() / name)) << name;
    EXPECT_EQ(file("DEBIAN/conffiles"), "/etc/eddy/exhibit.toml\n");
}

TEST_F(Package, HandsOnTheNoticesOfWhatIsLinkedIntoTheProgram) {
    const std::string doc = "usr/share/doc/eddy/";
    for (const char* package :
         {"libusb-1.0-0-dev", "libgpiod-dev", "libpng-dev", "zlib1g-dev", "libfmt-dev", "libtomlplusplus-dev",
          "nlohmann-json3-dev", "libcli11-dev", "libglm-dev", "libstb-dev", "fonts-dejavu-core"}) {
        EXPECT_GT(file(doc + "third-party/" + package).size(), 500U) << package;
        EXPECT_THAT(file(doc + "third-party/versions"), HasSubstr(package));
    }
    EXPECT_THAT(file(doc + "third-party/versions"), HasSubstr("libstdc++"));
    EXPECT_THAT(file(doc + "RELINKING.md"), HasSubstr("built from commit "));
}

TEST_F(Package, NeedsTheDriverStackAndNothingThatOneDebianLacks) {
    const std::string control = file("DEBIAN/control");
    for (const char* package : {"libc6", "libegl1", "libgles2", "libudev1", "libgl1-mesa-dri", "systemd"})
        EXPECT_THAT(control, HasSubstr(package));
    EXPECT_THAT(control, Not(HasSubstr("t64")));
}

TEST_F(Package, HoldsScriptsThatAShellCanRead) {
    for (const char* script : {"postinst", "prerm", "postrm"}) {
        const Ended read = Program({"sh", "-n", folder_ / (std::string("DEBIAN/") + script)}).wait();
        EXPECT_EQ(read.status, 0) << script << ": " << read.err;
    }
}

TEST_F(Package, HoldsAProgramThatRunsAndTakesItsOwnSettings) {
    const Ended checked =
        Program({folder_ / "usr/bin/eddy", "check-config", folder_ / "etc/eddy/exhibit.toml"}).wait();
    EXPECT_EQ(checked.status, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("good exhibit settings"));
}

/// On a copy of this machine: installs the package, and does what `then` says; what it printed. udev may be missing here.
std::string installed(const std::string& before, const std::string& then) {
    const std::string script =
        "set -e; " + before +
        "; cat > /root/eddy.deb; dpkg --force-depends -i /root/eddy.deb >/dev/null 2>&1; " + then;
    const Ended ended =
        Program({"sh", "-c", "exec \"$0\" \"$@\" < " EDDY_PACKAGE, kOnACopy, "sh", "-c", script}).wait();
    return ended.status == 77 ? "skip" : ended.out + ended.err;
}

TEST_F(Package, InstalledMakesItsUserAndFoldersAndStartsWithTheMachine) {
    const std::string said =
        installed("true",
                  "id -nG eddy; stat -c '%U %a %n' /var/lib/eddy /run/eddy /etc/eddy/conf.d; "
                  "systemctl --root=/ is-enabled eddy.service eddy-poweroff.path; eddy check-config "
                  "/etc/eddy/exhibit.toml");
    if (said == "skip") GTEST_SKIP() << "skipped: needs root and overlays";
    EXPECT_EQ(said,
              "eddy video render\neddy 755 /var/lib/eddy\neddy 755 /run/eddy\nroot 755 /etc/eddy/conf.d\n"
              "enabled\nenabled\n/etc/eddy/exhibit.toml: good exhibit settings\n");
}

TEST_F(Package, OnADesktopItTakesTheScreenOnlyWhenItIsTold) {
    const std::string said =
        installed("ln -sf /lib/systemd/system/gdm.service /etc/systemd/system/display-manager.service",
                  "systemctl --root=/ is-enabled eddy.service || true");
    if (said == "skip") GTEST_SKIP() << "skipped: needs root and overlays";
    EXPECT_EQ(said, "disabled\n");
}

TEST_F(Package, KeepsWhatItsOwnerWroteWhenItIsInstalledAgainAndNothingWhenItIsPurged) {
    const std::string said = installed(
        "true",
        "echo '# mine' >> /etc/eddy/exhibit.toml; dpkg --force-depends -i /root/eddy.deb >/dev/null 2>&1; "
        "tail -n 1 /etc/eddy/exhibit.toml; dpkg -P eddy >/dev/null 2>&1; "
        "ls -d /var/lib/eddy /etc/eddy /run/eddy /usr/share/doc/eddy 2>/dev/null || true; "
        "find /etc/systemd /var/lib/systemd -name '*eddy*'");
    if (said == "skip") GTEST_SKIP() << "skipped: needs root and overlays";
    EXPECT_EQ(said, "# mine\n");
}

}  // namespace
}  // namespace eddy
