#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

/// What a driver vendor or the C library imposes; everything else is linked in.
const std::set<std::string> kAllowed{"libc.so.6",   "libm.so.6",   "libEGL.so.1", "libGLESv2.so.2",
                                     "libgbm.so.1", "libdrm.so.2", "libudev.so.1"};

TEST(Needed, HoldsOnlyTheDriverStackAndTheCLibrary) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "skipped: a sanitizer comes as a dynamic library";
#endif
    const Ended readelf = Program({"readelf", "-d", "-W", EDDY_BINARY}).wait();
    ASSERT_EQ(readelf.status, 0) << readelf.err;
    const std::regex needed(R"(\(NEEDED\).*\[(.*)\])");
    int libraries = 0;
    for (const std::string& line : lines_of(readelf.out)) {
        std::smatch m;
        if (!std::regex_search(line, m, needed)) continue;
        ++libraries;
        const std::string name = m[1];
        EXPECT_TRUE(kAllowed.contains(name) || name.rfind("ld-linux", 0) == 0)
            << name << " is linked dynamically";
    }
    EXPECT_GT(libraries, 2) << "readelf said something this test does not understand:\n" << readelf.out;
}

TEST(Needed, LooksNowhereSpecialForLibraries) {
    const Ended readelf = Program({"readelf", "-d", "-W", EDDY_BINARY}).wait();
    EXPECT_EQ(readelf.out.find("RUNPATH"), std::string::npos) << readelf.out;
    EXPECT_EQ(readelf.out.find("RPATH"), std::string::npos) << readelf.out;
}

}  // namespace
}  // namespace eddy
