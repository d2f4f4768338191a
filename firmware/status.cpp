#include "firmware/status.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "firmware/text_file.h"

namespace eddy {
namespace {

/// What is not known is null.
nlohmann::ordered_json to_json(const CostFigures& c) {
    nlohmann::ordered_json j{{"preset", c.preset},
                             {"cells", {c.cells.x, c.cells.y, c.cells.z}},
                             {"iterations", c.iterations},
                             {"steps_per_s", c.steps_per_s},
                             {"target_steps_per_s", c.target_steps_per_s},
                             {"force_error_share", nullptr},
                             {"force_ripple_n", nullptr},
                             {"force_ripple_share", nullptr},
                             {"divergence_before_1_s", c.divergence_before_1_s},
                             {"divergence_after_1_s", c.divergence_after_1_s},
                             {"step_ms", c.step_ms},
                             {"stages_ms", nlohmann::ordered_json::object()},
                             {"picture_ms", c.picture_ms},
                             {"quality_down", c.quality_down},
                             {"quality_up", c.quality_up},
                             {"quality_note", c.quality_note}};
    if (c.force_error) j["force_error_share"] = *c.force_error;
    if (c.ripple) {
        j["force_ripple_n"] = c.ripple->rms;
        j["force_ripple_share"] = c.ripple->share;
    }
    for (const CostFigures::Stage& stage : c.stages) j["stages_ms"][stage.name] = stage.ms;
    return j;
}

nlohmann::ordered_json to_json(const Usage& usage) {
    nlohmann::ordered_json j;
    for (const UsageCounter& counter : kUsageCounters) j[std::string(counter.name)] = usage.*counter.count;
    return j;
}

nlohmann::ordered_json to_json(const VitalSigns& v) {
    const std::size_t all = FrameTimes::kBounds_s.size();
    nlohmann::ordered_json j{{"state", to_word(v.state)},
                             {"opening", v.opening},
                             {"clock_synchronised", v.clock_synchronised},
                             {"frames", v.frames.up_to(all)},
                             {"frames_s", v.frames.sum_s()},
                             {"config_good", v.config_good},
                             {"config_taken_at_s", v.config_taken_at_s},
                             {"config_hash", v.config_hash},
                             {"gpu_resets", v.gpu_resets},
                             {"disk_errors", v.disk_errors},
                             {"temperature_c", nullptr},
                             {"today", to_json(v.today)},
                             {"total", to_json(v.total)}};
    if (v.temperature_c) j["temperature_c"] = *v.temperature_c;
    return j;
}

}  // namespace

std::vector<GuardFigure> guard_figures(const Status& s) {
    return {{"step_refused", s.guards.step_refused},
            {"step_shortened", s.guards.step_shortened},
            {"body_not_finite", s.guards.body_not_finite},
            {"body_not_unit", s.guards.body_not_unit},
            {"body_far", s.guards.body_far},
            {"body_too_fast", s.guards.body_too_fast},
            {"unsound_steps", s.guards.unsound_steps},
            {"hand_placed", s.show.placed}};
}

bool write_status(const std::filesystem::path& file, const Status& s) {
    nlohmann::ordered_json j;
    j["eddy_version"] = EDDY_VERSION;
    j["uptime_s"] = s.uptime_s;
    j["scene"] = s.scene;
    j["renderer"] = s.renderer;
    j["display"] = s.display;
    j["fluid"] = {{"steps", s.show.steps},
                  {"rested", s.show.rested},
                  {"period_s", s.show.fluid_period_s},
                  {"divergence_before_1_s", s.show.divergence_before_1_s},
                  {"divergence_after_1_s", s.show.divergence_after_1_s},
                  {"fastest_m_s", s.show.fastest_m_s},
                  {"sub_steps", s.show.sub_steps},
                  {"most_force_n", s.show.most_force_n}};
    for (const GuardFigure& guard : guard_figures(s)) j["guards"][std::string(guard.name)] = guard.count;
    j["cost"] = to_json(s.cost);
    const HapticCounters& c = s.loop.device_counters;
    j["haptics"] = {{"device", s.haptic_device},
                    {"state", to_string(s.loop.device)},
                    {"force", to_string(s.loop.reason)},
                    {"ticks", s.loop.ticks},
                    {"late", s.loop.late},
                    {"missed", s.loop.missed},
                    {"worst_late_ms", Seconds(s.loop.worst_late).count() * 1e3},
                    {"answer_late_ms", s.loop.fluid_lateness.count() * 1e3},
                    {"gain", s.gain.now},
                    {"gain_of_scene", s.gain.of_scene},
                    {"gain_changes", s.gain.changes},
                    {"model_drag_ns_m", s.loop.force.drag_ns_m},
                    {"model_added_kg", s.loop.force.added_kg},
                    {"model_drag_share", s.loop.force.drag_share},
                    {"model_added_share", s.loop.force.added_share},
                    {"model_explains", s.loop.force.explained},
                    {"energy_debt_j", -s.loop.force.least_j},
                    {"energy_damped", s.loop.force.damped},
                    {"released", s.loop.hand.released},
                    {"released_false_alarms", s.loop.hand.false_alarms},
                    {"flights", s.flights},
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
                    {"lost", c.lost},
                    {"line_faults", c.line_faults},
                    {"usb_errors", c.usb_errors},
                    {"failed_boots", c.failed_boots},
                    {"wrong_echoes", c.wrong_echoes},
                    {"given_up", c.given_up}};
    j["exhibit"] = to_json(s.vital_signs);
    try {
        replace_text_file(file, j.dump(2) + "\n");
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace eddy
