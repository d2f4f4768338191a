#include "hal/display/kms/console.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

namespace eddy::kms {
namespace {

TEST(Console, AServiceWithoutATerminalHasNone) {
    Console none("/nonexistent/tty");
    EXPECT_FALSE(none.owned());
    none.set_text(false);
    none.set_text(true);
}

TEST(Console, ARemoteSessionIsNone) {
    const int session = posix_openpt(O_RDWR | O_NOCTTY);
    if (session < 0 || grantpt(session) != 0 || unlockpt(session) != 0)
        GTEST_SKIP() << "skipped: no pseudo terminals here";
    const char* const name = ptsname(session);
    ASSERT_NE(name, nullptr);
    Console console(name);
    EXPECT_FALSE(console.owned()) << name << " has no text mode";
    close(session);
}

}  // namespace
}  // namespace eddy::kms
