#include "firmware/status.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "firmware/text_file.h"

namespace eddy {

bool write_status(const std::filesystem::path& file, const Status& s) {
    nlohmann::ordered_json j;
    j["eddy_version"] = EDDY_VERSION;
    j["uptime_s"] = s.uptime_s;
    j["scene"] = s.scene;
    j["renderer"] = s.renderer;
    j["display"] = s.display;
    j["fluid"] = {{"steps", s.show.steps},
                  {"period_s", s.show.fluid_period_s},
                  {"divergence_before_1_s", s.show.divergence_before_1_s},
                  {"divergence_after_1_s", s.show.divergence_after_1_s},
                  {"most_force_n", s.show.most_force_n}};
    const HapticCounters& c = s.loop.device_counters;
    j["haptics"] = {{"device", s.haptic_device},
                    {"state", to_string(s.loop.device)},
                    {"force", to_string(s.loop.reason)},
                    {"ticks", s.loop.ticks},
                    {"late", s.loop.late},
                    {"missed", s.loop.missed},
                    {"worst_late_ms", Seconds(s.loop.worst_late).count() * 1e3},
                    {"clamped", s.loop.gate.clamped},
                    {"slewed", s.loop.gate.slewed},
                    {"not_finite", s.loop.gate.non_finite},
                    {"exchanges", c.exchanges},
                    {"timeouts", c.timeouts},
                    {"bad_bytes", c.bad_bytes},
                    {"implausible", c.implausible},
                    {"unsolved", c.unsolved},
                    {"saturated", c.saturated},
                    {"rehomed", c.rehomed},
                    {"lost", c.lost}};
    try {
        replace_text_file(file, j.dump(2) + "\n");
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace eddy
