// Preloaded into a program, puts an emulated Falcon on its USB, in real time. What is asked for in the environment:
// EDDY_TEST_FALCON  cold, unhomed or warm: what the device is doing when the program starts
// EDDY_TEST_UNPLUG  "1.5-2.5": pulled out and put back after so many seconds

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "tests/usb/bus.h"

namespace eddy {
namespace {

/// A hand that moves in and out all the time, and so homes the device when it wants to be homed.
class InAndOut final : public emulated::HandMotion {
  public:
    glm::dvec3 position_m(Seconds t) const override { return {0.0, 0.0, 0.047 * std::sin(6.0 * t.count())}; }
};

emulated::BoardState start_from(std::string_view word) {
    if (word == "cold") return emulated::BoardState::Cold;
    if (word == "unhomed") return emulated::BoardState::RunUnhomed;
    return emulated::BoardState::RunHomed;
}

__attribute__((constructor)) void plug_in() {
    const char* start = std::getenv("EDDY_TEST_FALCON");
    if (!start) return;
    const usb::InKernel kernel;
    usb::Bus& bus = usb::Bus::instance();
    bus.use_real_time();
    auto falcon = std::make_unique<emulated::EmulatedFalcon>(
        std::make_unique<InAndOut>(), emulated::PlantSettings{.hand = emulated::Hand::OnPath},
        emulated::BoardSettings{.start = start_from(start)});
    usb::Port& port = bus.plug(std::move(falcon));
    const char* times = std::getenv("EDDY_TEST_UNPLUG");
    double from = 0.0, to = 0.0;
    if (!times || std::sscanf(times, "%lf-%lf", &from, &to) != 2) return;
    std::thread([&bus, &port, from, to] {
        std::this_thread::sleep_for(Seconds(from));
        bus.unplug(port);
        std::this_thread::sleep_for(Seconds(to - from));
        bus.replug(port, true);
    }).detach();
}

}  // namespace
}  // namespace eddy
