#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <cstdlib>
#include <system_error>

#include "hal/gpio/emulated_gpio.h"
#include "hal/gpio/find_line.h"
#include "hal/gpio/real_gpio.h"
#include "tests/gpio/kernel.h"
#include "tests/scratch_folder.h"

// What everything that calls itself Gpio does: the emulated one; the real one, through libgpiod, above an emulated kernel; and the
// real one above this machine's kernel, with the chip that EDDY_GPIO_CHIP names (label, name or path). Lines 0 and 1 of that chip
// are driven: let nothing hang on them but lamps.

namespace eddy {
namespace {

using testing::HasSubstr;

/// A header of four lines that tells edges, and a bridge of two that does not.
class Bench {
  public:
    virtual ~Bench() = default;
    virtual Gpio& gpio() = 0;
    virtual std::string header() const { return "header"; }
    /// Somebody can move its inputs, and pull its plug.
    virtual bool has_hands() const { return true; }
    virtual void set_high(const std::string&, unsigned, bool) {}
    virtual bool is_high(const std::string&, unsigned) { return false; }
    virtual void unplug_bridge() {}
    virtual void plug_in_bridge() {}
};

class EmulatedBench final : public Bench {
  public:
    EmulatedBench() {
        gpio_.add("header", {"button", "lamp", "stop", ""});
        gpio_.add("bridge", {"", ""}, false);
    }
    Gpio& gpio() override { return gpio_; }
    void set_high(const std::string& chip, unsigned line, bool high) override {
        gpio_.set_high(fmt::format("{}:{}", chip, line), high);
    }
    bool is_high(const std::string& chip, unsigned line) override {
        return gpio_.is_high(fmt::format("{}:{}", chip, line));
    }
    void unplug_bridge() override { gpio_.unplug("bridge"); }
    void plug_in_bridge() override { gpio_.plug_in("bridge"); }

  private:
    EmulatedGpio gpio_;
};

class KernelBench final : public Bench {
  public:
    KernelBench()
        : header_(kernel_.add(folder_.write("gpiochip0", ""), "header", {"button", "lamp", "stop", ""})),
          bridge_(kernel_.add(folder_.write("gpiochip1", ""), "bridge", {"", ""}, false)) {}
    ~KernelBench() override { kernel_.clear(); }
    KernelBench(const KernelBench&) = delete;
    KernelBench& operator=(const KernelBench&) = delete;

    Gpio& gpio() override { return *gpio_; }
    void set_high(const std::string& chip, unsigned line, bool high) override {
        kernel_.set_high(called(chip), line, high);
    }
    bool is_high(const std::string& chip, unsigned line) override {
        return kernel_.is_high(called(chip), line);
    }
    void unplug_bridge() override { kernel_.unplug(bridge_); }
    void plug_in_bridge() override { kernel_.plug_in(bridge_, folder_.write("gpiochip7", "")); }

    gpio::Chip& called(const std::string& chip) { return chip == "header" ? header_ : bridge_; }
    std::string file(const std::string& name) const { return folder_ / name; }

  private:
    ScratchFolder folder_;
    gpio::Kernel& kernel_ = gpio::Kernel::instance();
    gpio::Chip& header_;
    gpio::Chip& bridge_;
    std::unique_ptr<Gpio> gpio_ = make_real_gpio(folder_.path());
};

class ChipBench final : public Bench {
  public:
    explicit ChipBench(std::string chip) : chip_(std::move(chip)) {}
    Gpio& gpio() override { return *gpio_; }
    std::string header() const override { return chip_; }
    bool has_hands() const override { return false; }

  private:
    std::string chip_;
    std::unique_ptr<Gpio> gpio_ = make_real_gpio();
};

enum class World { Emulated, Libgpiod, ThisMachine };

class GpioContract : public testing::TestWithParam<World> {
  protected:
    void SetUp() override {
        if (GetParam() == World::Emulated) bench = std::make_unique<EmulatedBench>();
        if (GetParam() == World::Libgpiod) bench = std::make_unique<KernelBench>();
        if (GetParam() != World::ThisMachine) return;
        const char* chip = std::getenv("EDDY_GPIO_CHIP");
        if (!chip) GTEST_SKIP() << "skipped: EDDY_GPIO_CHIP names no chip whose lines 0 and 1 may be driven";
        bench = std::make_unique<ChipBench>(chip);
    }
    std::string header(unsigned line) const { return fmt::format("{}:{}", bench->header(), line); }
    std::unique_ptr<GpioLine> open(const std::string& address, const GpioWish& wish = {}) {
        return open_line(bench->gpio(), address, wish);
    }

    std::unique_ptr<Bench> bench;
};

#define NEEDS_HANDS()        \
    if (!bench->has_hands()) \
    GTEST_SKIP() << "skipped: nobody moves the inputs of a real chip, or pulls its plug"

std::string name_of(const testing::TestParamInfo<World>& world) {
    switch (world.param) {
        case World::Emulated:
            return "Emulated";
        case World::Libgpiod:
            return "Libgpiod";
        case World::ThisMachine:
            break;
    }
    return "ThisMachine";
}
INSTANTIATE_TEST_SUITE_P(Of, GpioContract,
                         testing::Values(World::Emulated, World::Libgpiod, World::ThisMachine), name_of);

bool readable(int fd) {
    pollfd waiting{fd, POLLIN, 0};
    return poll(&waiting, 1, 0) > 0;
}

/// The errno of what is thrown; 0: nothing.
template <class Act>
int error_of(const Act& act) {
    try {
        act();
    } catch (const std::system_error& e) {
        return e.code().value();
    }
    return 0;
}

std::string refusal_of(Gpio& gpio, const std::string& address) {
    try {
        open_line(gpio, address, {});
    } catch (const GpioError& e) {
        return e.what();
    }
    return "opened";
}

TEST_P(GpioContract, ListsChipsAndLines) {
    const std::vector<GpioChip> chips = bench->gpio().chips();
    if (!bench->has_hands()) {
        EXPECT_GE(find_line(chips, header(1)).chip_path.size(), 1U);
        return;
    }
    ASSERT_EQ(chips.size(), 2U);
    EXPECT_EQ(chips[0].label, "header");
    EXPECT_EQ(chips[0].name, "gpiochip0");
    ASSERT_EQ(chips[0].lines.size(), 4U);
    EXPECT_EQ(chips[0].lines[2].name, "stop");
    EXPECT_EQ(chips[0].lines[3].name, "");
    EXPECT_FALSE(chips[0].lines[2].used);
    EXPECT_EQ(chips[1].lines.size(), 2U);
}

TEST_P(GpioContract, ReadsAnInputEitherWayRound) {
    NEEDS_HANDS();
    for (const bool active_low : {false, true}) {
        const auto line = open("button", {.active_low = active_low});
        bench->set_high("header", 0, false);
        EXPECT_EQ(line->active(), active_low);
        bench->set_high("header", 0, true);
        EXPECT_EQ(line->active(), !active_low);
    }
}

TEST_P(GpioContract, AnOutputBeginsInactiveAndIsDriven) {
    for (const bool active_low : {false, true}) {
        const auto line = open(header(1), {.output = true, .active_low = active_low});
        EXPECT_FALSE(line->active());
        EXPECT_EQ(line->edges_fd(), -1);
        for (const bool on : {true, false, true}) {
            line->set(on);
            EXPECT_EQ(line->active(), on);
            if (bench->has_hands()) {
                EXPECT_EQ(bench->is_high("header", 1), on != active_low);
            }
        }
    }
}

TEST_P(GpioContract, AnInputIsNotDriven) {
    NEEDS_HANDS();
    const auto line = open("button");
    EXPECT_EQ(error_of([&] { line->set(true); }), EPERM);
}

TEST_P(GpioContract, TellsOfEdgesUntilTheyAreTaken) {
    NEEDS_HANDS();
    const auto line = open("stop");
    bench->set_high("header", 0, false);
    ASSERT_GE(line->edges_fd(), 0);
    EXPECT_FALSE(readable(line->edges_fd()));
    for (int i = 0; i < 40; ++i) bench->set_high("header", 2, i % 2 == 1);
    EXPECT_TRUE(readable(line->edges_fd()));
    EXPECT_TRUE(line->take_edges()) << "it became active, and idle again, and active";
    EXPECT_FALSE(readable(line->edges_fd()));
    EXPECT_TRUE(line->active());
    EXPECT_FALSE(line->take_edges());
    bench->set_high("header", 2, false);
    EXPECT_TRUE(readable(line->edges_fd()));
    EXPECT_FALSE(line->take_edges()) << "it became idle";
}

TEST_P(GpioContract, AChipWithoutEdgesIsRead) {
    NEEDS_HANDS();
    const auto line = open("bridge:1");
    EXPECT_EQ(line->edges_fd(), -1);
    EXPECT_FALSE(line->take_edges());
    bench->set_high("bridge", 1, true);
    EXPECT_TRUE(line->active());
    bench->set_high("bridge", 1, false);
    EXPECT_FALSE(line->active());
}

TEST_P(GpioContract, ALineHasOneOwnerWhoIsNamed) {
    auto line = open(header(0));
    const GpioPlace place = find_line(bench->gpio().chips(), header(0));
    EXPECT_TRUE(place.info.used);
    EXPECT_EQ(place.info.consumer, "eddy");
    EXPECT_FALSE(place.info.output);
    EXPECT_EQ(error_of([&] { bench->gpio().request(place.chip_path, 0, {}); }), EBUSY);
    EXPECT_THAT(refusal_of(bench->gpio(), header(0)), HasSubstr("is used by an eddy that runs already"));
    line.reset();
    EXPECT_FALSE(find_line(bench->gpio().chips(), header(0)).info.used);
    EXPECT_NE(open(header(0)), nullptr);
}

TEST_P(GpioContract, TwoLinesOfAChipHaveTwoOwners) {
    const auto input = open(header(0));
    const auto output = open(header(1), {.output = true});
    output->set(true);
    EXPECT_TRUE(output->active());
    EXPECT_TRUE(find_line(bench->gpio().chips(), header(1)).info.output);
}

TEST_P(GpioContract, ALineThatIsNotThereIsRefused) {
    const std::string path = find_line(bench->gpio().chips(), header(0)).chip_path;
    EXPECT_EQ(error_of([&] { bench->gpio().request(path, 100'000, {}); }), EINVAL);
    EXPECT_NE(error_of([&] { bench->gpio().request("/dev/gpiochip99999", 0, {}); }), 0);
}

TEST_P(GpioContract, ABridgeThatIsUnpluggedIsGoneAndItsLinesSaySo) {
    NEEDS_HANDS();
    const auto input = open("bridge:0");
    const auto output = open("bridge:1", {.output = true});
    bench->unplug_bridge();
    EXPECT_EQ(error_of([&] { input->active(); }), ENODEV);
    EXPECT_EQ(error_of([&] { output->set(true); }), ENODEV);
    EXPECT_EQ(bench->gpio().chips().size(), 1U);
    EXPECT_THAT(refusal_of(bench->gpio(), "bridge:0"), HasSubstr("there is no GPIO chip 'bridge'"));
    bench->plug_in_bridge();
    EXPECT_EQ(error_of([&] { input->active(); }), ENODEV) << "it is another now";
    const auto again = open("bridge:0");
    bench->set_high("bridge", 0, true);
    EXPECT_TRUE(again->active());
}

// --- what is libgpiod's alone ----------------------------------------------------------------------------------------

TEST(Libgpiod, AsksForAPullUpWhereTheKernelKnowsOfThem) {
    KernelBench bench;
    open_line(bench.gpio(), "button", {});
    EXPECT_EQ(bench.called("header").pull_ups, 1U);
    bench.called("header").biases = false;
    const auto line = open_line(bench.gpio(), "button", {});
    EXPECT_GE(line->edges_fd(), 0);
    EXPECT_EQ(bench.called("header").pull_ups, 1U);
}

TEST(Libgpiod, WhoWaitsForAnEdgeIsWokenWhenTheChipGoes) {
    KernelBench bench;
    bench.called("bridge").edges = true;
    const auto line = open_line(bench.gpio(), "bridge:0", {});
    ASSERT_GE(line->edges_fd(), 0);
    EXPECT_FALSE(readable(line->edges_fd()));
    bench.unplug_bridge();
    EXPECT_TRUE(readable(line->edges_fd()));
    line->take_edges();
    EXPECT_EQ(error_of([&] { line->active(); }), ENODEV);
}

TEST(Libgpiod, SaysWhichChipsMayNotBeOpenedAndWhatToDo) {
    KernelBench bench;
    bench.called("header").refusal = EACCES;
    const std::vector<GpioChip> chips = bench.gpio().chips();
    ASSERT_EQ(chips.size(), 2U);
    EXPECT_THAT(chips[0].trouble, HasSubstr("this user may not open it"));
    EXPECT_EQ(chips[1].trouble, "");
    EXPECT_THAT(refusal_of(bench.gpio(), "button"), HasSubstr("gpiochip0: this user may not open it"));
    EXPECT_THAT(refusal_of(bench.gpio(), bench.file("gpiochip0") + ":1"), HasSubstr("may not open it"));
    bench.called("header").refusal = EMFILE;
    EXPECT_THAT(refusal_of(bench.gpio(), "button"), HasSubstr("Too many open files"));
}

TEST(Libgpiod, AFileThatOnlyHasTheNameOfAChipIsNone) {
    const ScratchFolder folder;
    folder.write("gpiochip3", "");
    folder.write("gpiochip", "");
    folder.write("gpiochip4x", "");
    const auto gpio = make_real_gpio(folder.path());
    ASSERT_EQ(gpio->chips().size(), 1U);
    EXPECT_THAT(gpio->chips()[0].trouble, HasSubstr("cannot be opened"));
    EXPECT_TRUE(make_real_gpio(folder / "nowhere")->chips().empty());
}

TEST(Libgpiod, LeavesNoFileOpen) {
    KernelBench bench;
    const auto open_files = [] {
        std::size_t count = 0;
        for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator("/proc/self/fd"))
            ++count;
        return count;
    };
    const std::size_t before = open_files();
    for (int i = 0; i < 20; ++i) {
        open_line(bench.gpio(), "button", {});
        open_line(bench.gpio(), "lamp", {.output = true});
        EXPECT_THAT(refusal_of(bench.gpio(), "nothing"), HasSubstr("there is no GPIO line called"));
    }
    EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace eddy
