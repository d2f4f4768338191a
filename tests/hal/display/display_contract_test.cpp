#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "hal/display/display.h"
#include "hal/display/emulated/emulated_machine.h"
#include "hal/display/kms/kms_display.h"

// What every display promises: the emulated one always, the machine's own where it has one that nobody else uses.

namespace eddy {
namespace {

using namespace std::chrono_literals;

class Subject {
  public:
    virtual ~Subject() = default;
    virtual Display& display() = 0;
    virtual Instant wait(Instant time) = 0;  ///< then, what time it is
};

class EmulatedSubject final : public Subject {
  public:
    Display& display() override { return display_; }
    Instant wait(Instant time) override {
        machine_.wait(time);
        return machine_.now();
    }

  private:
    emulated::ScreenMachine machine_;
    kms::KmsDisplay display_{machine_.machine(), {}};
};

class HeadlessSubject final : public Subject {
  public:
    Display& display() override { return *display_; }
    Instant wait(Instant time) override { return now_ += time; }

  private:
    std::unique_ptr<Display> display_ = make_software_display();
    Instant now_{0};
};

class RealSubject final : public Subject {
  public:
    Display& display() override { return display_; }
    Instant wait(Instant time) override {
        clock_.sleep_until(clock_.now() + time);
        return clock_.now();
    }

  private:
    RealClock clock_;
    kms::KmsDisplay display_{kms::make_machine(), {}};
};

/// Why this machine's screen cannot be tried; empty if it can.
std::string no_real_screen() {
    const auto machine = kms::make_machine();
    const std::vector<std::string> cards = machine->cards();
    if (cards.empty()) return "no /dev/dri/card* on this machine";
    for (const std::string& path : cards) {
        const auto opened = machine->open(path);
        if (opened.card && opened.card->is_master()) return "";
    }
    return "no card of this machine can be had: no permission, or another program has the screen";
}

class DisplayContract : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        if (GetParam() == "real") {
            if (const std::string why = no_real_screen(); !why.empty()) GTEST_SKIP() << "skipped: " << why;
            subject = std::make_unique<RealSubject>();
        } else if (GetParam() == "headless") {
            subject = std::make_unique<HeadlessSubject>();
        } else {
            subject = std::make_unique<EmulatedSubject>();
        }
    }
    DisplayState run(Instant time) {
        DisplayState state{};
        for (Instant gone{0}; gone < time; gone += 10ms)
            state = subject->display().poll(now = subject->wait(10ms));
        return state;
    }
    std::unique_ptr<Subject> subject;
    Instant now{0};
};

TEST_P(DisplayContract, HasASizeExactlyWhenThereIsAWindow) {
    Display& display = subject->display();
    const DisplayState state = run(100ms);
    EXPECT_EQ(display.size_px().has_value(), state == DisplayState::Showing);
    if (display.size_px()) {
        EXPECT_GT(display.size_px()->width, 0);
        EXPECT_GT(display.size_px()->height, 0);
    }
    if (display.native_window()) {
        EXPECT_TRUE(display.size_px());
    }
}

TEST_P(DisplayContract, WantsAFrameOnlyWhenItCouldBeSeen) {
    Display& display = subject->display();
    EXPECT_EQ(run(100ms) == DisplayState::Showing, display.wants_frame());
}

TEST_P(DisplayContract, ThatIsAsleepSaysSoAndWantsNothing) {
    Display& display = subject->display();
    run(100ms);
    display.set_awake(false);
    EXPECT_EQ(run(100ms), DisplayState::Asleep);
    EXPECT_FALSE(display.wants_frame());
    display.present();
    EXPECT_EQ(display.counters().flips, 0) << "nothing was ever drawn";
}

TEST_P(DisplayContract, AWindowStaysTheSameAsLongAsNothingHappens) {
    Display& display = subject->display();
    run(100ms);
    const long number = display.window_number();
    const auto size = display.size_px();
    run(500ms);
    EXPECT_EQ(display.window_number(), number);
    EXPECT_EQ(display.size_px(), size);
}

TEST_P(DisplayContract, CanAlwaysSayWhatItIs) {
    Display& display = subject->display();
    EXPECT_NE(display.describe(), "");
    run(100ms);
    EXPECT_NE(display.describe(), "");
    EXPECT_NE(display.egl_platform(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Each, DisplayContract, testing::Values("emulated", "headless", "real"),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace eddy
