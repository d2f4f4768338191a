#include "firmware/quality/quality_control.h"

#include <fmt/format.h>

#include <algorithm>

#include "firmware/text_file.h"

namespace eddy {

QualityControl::QualityControl(gles::Gpu& gpu, const Scene& scene, Setup setup)
    : gpu_(gpu), scene_(scene), setup_(std::move(setup)), presets_(setup_.presets, setup_.preset_every) {
    if (setup_.presets.size() > 1 || setup_.tuning.empty()) return;
    if (const auto tuning = stored_tuning(setup_.tuning, scene, gpu.capabilities().renderer, trouble_)) {
        adopt(*tuning);
        adopted_.reset();  // begun with
    }
}

void QualityControl::adopt(const Tuning& tuning) {
    // One rung above the tuned one, for a machine that has become quicker.
    const std::size_t rungs = std::min(tuning.ladder.size(), tuning.chosen + 2);
    ladder_.assign(tuning.ladder.begin(), tuning.ladder.begin() + static_cast<std::ptrdiff_t>(rungs));
    GovernorSetup setup{{}, tuning.chosen, Seconds(scene_.solver.dt_s)};
    for (const Rung& rung : ladder_) setup.step_ms.push_back(rung.step_ms);
    governor_.emplace(setup);
    adopted_ = ladder_[tuning.chosen].quality;
    trouble_.clear();
}

Quality QualityControl::in_preset(SolverPreset preset) const {
    const Quality own = quality_of(scene_);
    return preset == own.preset ? own : with_preset(own, preset);
}

std::vector<Quality> QualityControl::all() const {
    std::vector<Quality> all;
    if (setup_.presets.size() > 1) {
        for (const SolverPreset preset : setup_.presets) all.push_back(in_preset(preset));
    } else if (governor_) {
        for (const Rung& rung : ladder_) all.push_back(rung.quality);
    } else {
        all.push_back(quality_of(scene_));
    }
    return all;
}

Quality QualityControl::first() const {
    return governor_ ? ladder_[governor_->figures().rung].quality : all().front();
}

std::optional<QualityControl::Change> QualityControl::update(Instant now, const Interval& since_last,
                                                             std::uint8_t buttons) {
    if (setup_.presets.size() > 1) {
        const auto chosen = presets_.look(now, buttons);
        if (!chosen) return std::nullopt;
        return Change{in_preset(*chosen), "another preset was chosen"};
    }
    if (adopted_) {
        const Quality quality = *std::exchange(adopted_, std::nullopt);
        return Change{quality, "this machine has been tuned"};
    }
    if (!governor_) return std::nullopt;
    // What went elsewhere made it late only where it did not fit into what the fluid left of its period.
    const Seconds on_time = std::min(since_last.length, Seconds(scene_.solver.dt_s));
    const Seconds of_a_step =
        (since_last.length - since_last.elsewhere) / static_cast<double>(since_last.steps);
    const auto rung = governor_->update(std::max(of_a_step, on_time));
    if (!rung) return std::nullopt;
    return Change{ladder_[*rung].quality, governor_->figures().reason};
}

void QualityControl::step_took(double busy_ms) {
    if (governor_) governor_->step_took(busy_ms);
}

std::optional<std::string> QualityControl::work() {
    if (gave_up_) return std::nullopt;
    try {
        if (setup_.presets.size() > 1) return measure_presets();
        return governor_ || setup_.tuning.empty() ? std::nullopt : tune();
    } catch (const std::exception& e) {  // of the driver, most likely: no memory for a larger grid
        tuner_.reset();
        measuring_.reset();
        gpu_.free_idle_textures();
        gave_up_ = true;
        trouble_ = e.what();
        return "measuring was given up until the next start: " + trouble_;
    }
}

std::optional<std::string> QualityControl::measure_presets() {
    for (const Quality& quality : all()) {
        if (errors_.contains(quality)) continue;
        if (!measuring_)
            measuring_ = std::make_unique<ForceError>(gpu_, scene_, quality, half_width_share(scene_));
        measuring_->work();
        if (measuring_->done()) {
            errors_[quality] = measuring_->error();
            measuring_.reset();
            gpu_.free_idle_textures();
        }
        break;
    }
    return std::nullopt;
}

std::optional<std::string> QualityControl::tune() {
    const bool begins = !tuner_;
    if (begins) tuner_ = std::make_unique<Tuner>(gpu_, scene_);
    if (begins) return fmt::format("tuning this machine while nobody is here, as {}", trouble_);
    tuner_->work();
    if (!tuner_->done()) return std::nullopt;
    const Tuning tuning = tuner_->tuning();
    tuner_.reset();
    adopt(tuning);
    const Rung& chosen = tuning.ladder[tuning.chosen];
    std::string text = fmt::format("tuned: {}, {:.1f} ms a step", describe(chosen.quality), chosen.step_ms);
    try {
        replace_text_file(setup_.tuning, to_json(tuning));
    } catch (const std::runtime_error& e) {
        text += fmt::format("; not kept for the next start: {}", e.what());
    }
    return text;
}

std::optional<double> QualityControl::force_error(const Quality& quality) const {
    for (const Rung& rung : ladder_)
        if (rung.quality == quality) return rung.force_error;
    const auto measured = errors_.find(quality);
    return measured != errors_.end() ? std::optional(measured->second) : std::nullopt;
}

int QualityControl::steps_down() const {
    return governor_ ? static_cast<int>(governor_->figures().steps_down) : 0;
}

int QualityControl::steps_up() const {
    return governor_ ? static_cast<int>(governor_->figures().steps_up) : 0;
}

std::string QualityControl::note() const {
    if (tuner_) return fmt::format("tuning: trying {}", tuner_->doing());
    if (gave_up_) return "measuring was given up: " + trouble_;
    if (!governor_) return trouble_.empty() ? "" : "not tuned: " + trouble_;
    const GovernorFigures figures = governor_->figures();
    return figures.trouble.empty() ? figures.reason : std::string(figures.trouble);
}

}  // namespace eddy
