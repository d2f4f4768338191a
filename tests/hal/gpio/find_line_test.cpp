#include "hal/gpio/find_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "hal/gpio/emulated_gpio.h"

namespace eddy {
namespace {

using testing::HasSubstr;
using testing::StrEq;

GpioChip chip(const std::string& path, const std::string& label, const std::vector<std::string>& names) {
    GpioChip chip{path, path.substr(5), label, ""};
    for (const std::string& name : names) chip.lines.push_back({.name = name, .consumer = {}});
    return chip;
}

const std::vector<GpioChip>& machine() {
    static const std::vector<GpioChip> chips{
        chip("/dev/gpiochip0", "pinctrl-bcm2711", {"ID_SDA", "GPIO17", "GPIO27", "RGMII:MDIO", "-"}),
        chip("/dev/gpiochip1", "cp2112_gpio", {"", "", "", ""}),
        chip("/dev/gpiochip2", "twin", {"-"}),
        chip("/dev/gpiochip3", "twin", {"a:1"}),
    };
    return chips;
}

std::string trouble(const std::string& address, const std::vector<GpioChip>& chips = machine()) {
    try {
        find_line(chips, address);
    } catch (const GpioError& e) {
        return e.what();
    }
    return "found";
}

TEST(FindLine, ByItsName) {
    const GpioPlace place = find_line(machine(), "GPIO27");
    EXPECT_EQ(place.chip_path, "/dev/gpiochip0");
    EXPECT_EQ(place.offset, 2U);
    EXPECT_EQ(find_line(machine(), "RGMII:MDIO").offset, 3U) << "a name may have a colon in it";
}

TEST(FindLine, ByTheChipsLabelNameOrPathAndOffset) {
    for (const char* address : {"cp2112_gpio:3", "gpiochip1:3", "/dev/gpiochip1:3"}) {
        const GpioPlace place = find_line(machine(), address);
        EXPECT_EQ(place.chip_path, "/dev/gpiochip1") << address;
        EXPECT_EQ(place.offset, 3U);
    }
}

TEST(FindLine, SaysTheNearestNames) {
    EXPECT_THAT(trouble("GPIO7"),
                StrEq("there is no GPIO line called 'GPIO7'; nearest: 'GPIO17', 'GPIO27', '-', "
                      "'a:1'; `eddy panel` lists all"));
    EXPECT_THAT(trouble("GPIO7", {machine()[1]}), HasSubstr("no line here has a name, write CHIP:OFFSET"));
}

TEST(FindLine, SaysTheNearestChips) {
    EXPECT_THAT(trouble("cp2111_gpio:0"),
                HasSubstr("there is no GPIO chip 'cp2111_gpio'; there are 'cp2112_gpio'"));
}

TEST(FindLine, SaysHowManyLinesAChipHas) {
    EXPECT_THAT(trouble("cp2112_gpio:4"), HasSubstr("has no line 4: it has 4, counted from 0"));
}

TEST(FindLine, DoesNotGuessAmongSeveral) {
    EXPECT_THAT(trouble("-"), HasSubstr("there are 2 GPIO lines called '-': say which by CHIP:OFFSET, "
                                        "pinctrl-bcm2711:4, twin:0"));
    EXPECT_THAT(trouble("twin:0"), HasSubstr("there are 2 GPIO chips 'twin'"));
    EXPECT_THAT(trouble("twin:0"), HasSubstr("/dev/gpiochip2, /dev/gpiochip3"));
}

TEST(FindLine, SaysThatThereIsNoChipAtAll) {
    EXPECT_THAT(trouble("GPIO17", {}), HasSubstr("there is no GPIO chip in this machine"));
}

TEST(FindLine, SaysWhichChipsItCouldNotLookInto) {
    std::vector<GpioChip> chips = machine();
    chips[0].lines.clear();
    chips[0].label.clear();
    chips[0].trouble = "this user may not open it";
    EXPECT_THAT(trouble("GPIO17", chips), HasSubstr("/dev/gpiochip0: this user may not open it"));
    EXPECT_THAT(trouble("pinctrl-bcm2711:17", chips), HasSubstr("/dev/gpiochip0: this user may not open it"));
    EXPECT_THAT(trouble("gpiochip0:17", chips), StrEq("/dev/gpiochip0: this user may not open it"));
}

TEST(OpenLine, SaysInWordsWhyALineIsRefused) {
    EmulatedGpio gpio;
    gpio.add("header", {"a", "b"});
    const auto refusal = [&gpio] {
        try {
            open_line(gpio, "b", {});
        } catch (const GpioError& e) {
            return std::string(e.what());
        }
        return std::string("opened");
    };
    gpio.use_elsewhere("b", "spi0 CS1");
    EXPECT_EQ(refusal(),
              "GPIO line 'b' (/dev/gpiochip0 line 1) is used by 'spi0 CS1': end that, or name another line");
    gpio.use_elsewhere("b", "");
    EXPECT_THAT(refusal(), HasSubstr("does not say its name"));
    gpio.refuse("b", EPERM);
    EXPECT_THAT(refusal(), HasSubstr("may not be requested by this user"));
    gpio.refuse("b", ENODEV);
    EXPECT_THAT(refusal(), HasSubstr("is its USB bridge plugged in?"));
    gpio.refuse("b", EIO);
    EXPECT_THAT(refusal(), HasSubstr("Input/output error"));
}

}  // namespace
}  // namespace eddy
