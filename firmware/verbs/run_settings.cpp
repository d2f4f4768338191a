#include "firmware/verbs/run_settings.h"

#include <fmt/format.h>

#include <ctime>

#include "firmware/verbs/run_options.h"

namespace eddy {
namespace {

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

}  // namespace

RunSettings::RunSettings(const RunOptions& options, const ConfigIntake::Setup& setup, Office& office,
                         const Clock& clock)
    : options_(options), office_(office), clock_(clock), intake_(setup) {
    choose();
}

/// Settings from a file that no run can carry out are as bad as those that cannot be read; orders of the command line end it.
void RunSettings::choose() {
    for (;;) {
        const std::uint64_t refused = report().refused;
        ConfigOffer offer = intake_.start();
        tell_what_is_wrong(refused);
        exhibit_ = with_options(offer.exhibit, options_);
        scene_ = offer.scene.scene;
        try {
            require_possible(options_, exhibit_, scene_);
            offer_ = std::move(offer);
            announced_ = false;
            return;
        } catch (const std::exception& e) {
            if (offer.source == ConfigSource::Factory) throw;
            refuse(offer, e.what());
        }
    }
}

void RunSettings::heed() {
    const std::uint64_t refused = report().refused;
    std::optional<ConfigOffer> offer = intake_.poll(clock_.now());
    tell_what_is_wrong(refused);
    if (offer) take(std::move(*offer));
}

void RunSettings::tell_what_is_wrong(std::uint64_t refused) {
    if (report().refused == refused) return;
    for (const Diagnostic& error : report().errors) office_.say(Event::ConfigRejected, to_string(error));
    news_.refused = true;
    good_ = false;
}

void RunSettings::take(ConfigOffer offer) {
    const Exhibit exhibit = with_options(offer.exhibit, options_);
    try {
        require_possible(options_, exhibit, offer.scene.scene);
    } catch (const std::exception& e) {
        refuse(offer, e.what());
        return;
    }
    if (nothing_runs()) {
        overtake(std::move(offer));
    } else if (offer.needs_new_scene()) {
        office_.service().reloading();
        offer_ = std::move(offer);
        announced_ = false;
    } else {
        exhibit_ = exhibit;
        taken(offer);
    }
}

/// What is being prepared for the start: nothing plays that should go on meanwhile.
void RunSettings::overtake(ConfigOffer offer) {
    office_.say(Event::Note, "newer settings came while the fluid was being prepared");
    intake_.building(offer.hash);
    exhibit_ = with_options(offer.exhibit, options_);
    scene_ = offer.scene.scene;
    if (offer.needs_new_scene()) announced_ = false;
    offer_ = std::move(offer);
    news_.apply = true;
}

RunSettings::Wish RunSettings::announce() {
    announced_ = true;
    intake_.building(offer_->hash);
    return {with_options(offer_->exhibit, options_), offer_->scene.scene};
}

void RunSettings::began(Seconds work) {
    if (!offer_) return;
    const ConfigOffer offer = *std::exchange(offer_, std::nullopt);
    exhibit_ = with_options(offer.exhibit, options_);
    scene_ = offer.scene.scene;
    if (!nothing_runs()) {
        office_.service().first_frame(clock_.now());  // the end of reloading
        office_.say(Event::Note, fmt::format("the new scene was ready after {:.1f} s of work", work.count()));
    }
    taken(offer);
}

void RunSettings::failed(const std::string& why) {
    const bool last_resort = !offer_ || (nothing_runs() && offer_->source == ConfigSource::Factory);
    if (last_resort) throw gles::GlError(why);
    const ConfigOffer offer = *std::exchange(offer_, std::nullopt);
    if (!nothing_runs()) office_.service().first_frame(clock_.now());
    refuse(offer, why);
    if (nothing_runs()) choose();
}

void RunSettings::taken(const ConfigOffer& offer) {
    const bool first = nothing_runs(), stood_in = report().stands_in;
    intake_.accepted(offer.hash, clock_.now());
    news_.apply = true;
    good_ = report().result == ConfigResult::Applied || report().result == ConfigResult::NotRead;
    taken_at_s_ = static_cast<double>(std::time(nullptr));
    office_.journal().set_config_hash(offer.hash);
    if (offer.source == ConfigSource::LastGood)
        office_.say(
            Event::ConfigFellBack,
            std::string("the last good settings, for those in the folder cannot be used") +
                (report().stop_unread ? "; no force, for those name another stop input, which nobody looks at"
                                      : ""));
    if (offer.source == ConfigSource::Factory && report().stands_in && !good_)
        office_.say(
            Event::ConfigFellBack,
            "the factory's settings stand in for the owner's: no force, for they know of no stop input; "
            "mend the owner's (eddy check-config), then start the program again");
    if (offer.source == ConfigSource::New && stood_in && report().stands_in)
        office_.say(Event::ConfigFellBack,
                    "still no force: some of the owner's settings wait for the next start of the program");
    if (first) return;
    std::string keys;
    for (const KeyChange& change : offer.changes)
        keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", change.key, change.to);
    office_.say(Event::ConfigTaken, keys.empty() ? "settings were taken" : "settings were taken: " + keys);
    news_.taken = true;
}

void RunSettings::refuse(const ConfigOffer& offer, const std::string& why) {
    intake_.refused(offer.hash, first_line(why));
    good_ = false;
    office_.say(Event::ConfigRejected, first_line(why));
    news_.refused = true;
}

}  // namespace eddy
