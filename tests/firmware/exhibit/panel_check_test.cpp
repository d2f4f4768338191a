#include "firmware/exhibit/panel_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "hal/gpio/emulated_gpio.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

/// Virtual time on which something happens.
class Staged final : public Clock {
  public:
    std::vector<std::pair<Instant, std::function<void()>>> acts;
    Instant now() const override { return now_; }
    void sleep_until(Instant t) override {
        now_ = std::max(t, now_);
        for (auto& [at, act] : acts)
            if (act && now_ >= at) std::exchange(act, nullptr)();
    }

  private:
    Instant now_{0};
};

struct Visit {
    EmulatedGpio gpio;
    GpioConfig config;
    PanelCheck check;
    Staged clock;
    bool well = false;

    Visit() {
        gpio.add("header", {"BUTTON", "STOP", "LAMP", "SPARE"});
        gpio.set_high("STOP", false);
        config.button = "BUTTON";
        config.stop = "header:1";
        config.lamp_red = "LAMP";
    }
    std::string said() {
        const ScratchFolder folder;
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen((folder / "said").c_str(), "w"),
                                                                   std::fclose);
        const std::function<bool()> never = [] { return false; };
        well = check_panel(gpio, config, check, clock, file.get(), never);
        std::fflush(file.get());
        return read_all(folder / "said");
    }
};

TEST(PanelCheck, ListsLinesAndTellsWhatIsPressed) {
    Visit visit;
    visit.gpio.use_elsewhere("SPARE", "fan");
    bool lit = false;
    visit.clock.acts = {{500ms, [&] { lit = visit.gpio.is_high("LAMP"); }},
                        {2000ms, [&] { visit.gpio.set_high("BUTTON", false); }},
                        {2200ms, [&] { visit.gpio.set_high("BUTTON", true); }},
                        {3000ms, [&] { visit.gpio.set_high("STOP", true); }}};
    const std::string said = visit.said();
    EXPECT_TRUE(visit.well);
    EXPECT_THAT(said, HasSubstr("/dev/gpiochip0: 'header', 4 lines"));
    EXPECT_THAT(said, HasSubstr("header:3                SPARE               input, used by 'fan'"));
    EXPECT_THAT(said, HasSubstr("lamp_green  none"));
    EXPECT_THAT(said, HasSubstr("lit: lamp_red\n"));
    EXPECT_THAT(said, Not(HasSubstr("lit: lamp_green")));
    EXPECT_TRUE(lit);
    EXPECT_FALSE(visit.gpio.is_high("LAMP")) << "dark again";
    EXPECT_THAT(said, HasSubstr("button: pressed\nbutton: not pressed\nbutton: a click"));
    EXPECT_THAT(said, HasSubstr("stop: pressed"));
}

TEST(PanelCheck, IsNotWellWithALineItCannotHave) {
    Visit visit;
    visit.config.button = "BUTON";
    EXPECT_THAT(visit.said(),
                HasSubstr("button      BUTON: there is no GPIO line called 'BUTON'; nearest: 'BUTTON'"));
    EXPECT_FALSE(visit.well);
}

TEST(PanelCheck, TellsOfALineThatGoesAway) {
    Visit visit;
    visit.clock.acts = {{2s, [&] { visit.gpio.unplug("header"); }}};
    EXPECT_THAT(visit.said(), HasSubstr("stop: GPIO line 'header:1' went away"));
    EXPECT_FALSE(visit.well);
}

TEST(PanelCheck, WithoutAnythingWiredSaysWhereToName) {
    Visit visit;
    visit.config = {};
    EXPECT_THAT(visit.said(), HasSubstr("nothing is wired: name its lines under [gpio]"));
    EXPECT_TRUE(visit.well);
}

TEST(PanelCheck, ShowsTheCodeThatIsAskedFor) {
    Visit visit;
    visit.check.code = LampCode::Fault;
    bool first = false, second = true;
    visit.clock.acts = {{100ms, [&] { first = visit.gpio.is_high("LAMP"); }},
                        {300ms, [&] { second = visit.gpio.is_high("LAMP"); }}};
    EXPECT_THAT(visit.said(), HasSubstr("lamps: fault: a fault that needs somebody"));
    EXPECT_TRUE(first);
    EXPECT_FALSE(second);
    EXPECT_FALSE(visit.gpio.is_high("LAMP")) << "dark again";
}

}  // namespace
}  // namespace eddy
