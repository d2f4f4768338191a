#include "firmware/exhibit/config_intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "config/override.h"
#include "firmware/built_from.h"
#include "firmware/exhibit/future.h"
#include "firmware/exhibit/start_ledger.h"
#include "firmware/text_file.h"
#include "firmware/utc_stamp.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

std::string this_program() {
    return fmt::format("{} ({})", EDDY_VERSION, kBuiltFrom);
}

/// Of text that is no TOML: whether a line of it gives `stop` a name.
bool names_a_stop(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        line.resize(std::min(line.find('#'), line.size()));
        std::erase_if(line, [](char c) { return c == ' ' || c == '\t'; });
        for (const std::string_view given : {"stop=\"", "stop='"})
            if (const std::size_t at = line.find(given); at != std::string::npos) {
                const std::size_t name = at + given.size();
                if (name < line.size() && line[name] != given.back()) return true;
            }
    }
    return false;
}

/// Whether the stop input of `now` may be another than that of `then`.
bool may_stop_elsewhere(const ConfigSet& now, const ConfigSet& then) {
    const GpioConfig &a = now.exhibit.exhibit.gpio, &b = then.exhibit.exhibit.gpio;
    if (now.good() || !a.stop.empty())
        return a.stop != b.stop || (!a.stop.empty() && a.stop_active_low != b.stop_active_low);
    if (!b.stop.empty()) return false;  // it is looked at: what cannot be read takes nothing away
    for (const auto* files : {&now.files.exhibit.own, &now.files.exhibit.drop_ins})
        for (const WrittenFile& file : *files)
            if (names_a_stop(file.text)) return true;
    return false;
}

bool contains(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

bool same_scene_files(const ConfigFiles& a, const ConfigFiles& b) {
    return a.scene == b.scene && a.refers == b.refers;
}

Diagnostic of_folder(const std::filesystem::path& folder, std::string message) {
    return diagnose({folder.string(), 0, 0}, "", std::move(message));
}

}  // namespace

bool ConfigOffer::needs_new_scene() const {
    return std::any_of(changes.begin(), changes.end(),
                       [](const KeyChange& c) { return c.takes_effect == TakesEffect::Scene; });
}

ConfigIntake::ConfigIntake(Setup setup, Disk& disk)
    : setup_(std::move(setup)),
      memory_(setup_.state_dir.empty() ? std::filesystem::path() : setup_.state_dir / "config",
              setup_.boot.empty() ? boot_id() : setup_.boot,
              setup_.program.empty() ? this_program() : setup_.program, disk) {}

void ConfigIntake::refuse(ConfigResult result, std::vector<Diagnostic> errors) {
    report_.result = result;
    report_.errors = std::move(errors);
    ++report_.refused;
}

std::optional<ConfigSet> ConfigIntake::good_one_in_folder() {
    ConfigSet set = read_config_set(setup_.folder, setup_.orders);
    watch(set);
    for (const Diagnostic& d : set.diagnostics)
        if (d.file == kOverrideFile) throw ConfigError(set.diagnostics);
    const bool seen = report_.hash == set.hash;
    report_.hash = set.hash;
    if (!seen) {
        if (auto why = objection(set)) {
            report_.stop_unread = last_good_ && may_stop_elsewhere(set, *last_good_);
            refuse(why->result, std::move(why->errors));
        } else if (!set.files.exhibit.none())
            return set;
    }
    return std::nullopt;
}

std::optional<ConfigIntake::Objection> ConfigIntake::objection(const ConfigSet& set) const {
    const auto because = [this](ConfigResult result, const char* why) {
        return Objection{result, {of_folder(setup_.folder, why)}};
    };
    if (set.files.exhibit.none()) {
        const bool had_some = running_ ? report_.source != ConfigSource::Factory
                              : open_  ? open_->source != ConfigSource::Factory
                                       : memory_.had_last_good();
        if (!had_some) return std::nullopt;
        return because(ConfigResult::Refused,
                       "no settings are here any more; for the factory's put an exhibit.toml "
                       "here that holds a comment");
    }
    if (!set.good()) return Objection{ConfigResult::Refused, set.diagnostics};
    const ConfigSet* before = running_     ? &*running_
                              : open_      ? &open_->set
                              : last_good_ ? &*last_good_
                                           : nullptr;
    // Without it the machine's ceiling of the force and its stop input would be gone, and nothing else be wrong.
    if (set.files.exhibit.own.empty() && before && !before->files.exhibit.own.empty())
        return because(ConfigResult::Refused,
                       "exhibit.toml is not here any more, only conf.d is; put it back, or one that holds "
                       "nothing but a comment");
    if (contains(refused_, set.hash))
        return because(ConfigResult::Refused, "these very settings could not be built before; change them");
    if (memory_.black_listed(set.hash))
        return because(ConfigResult::BlackListed,
                       "the program died within 30 s of taking these very settings; change them");
    return std::nullopt;
}

ConfigOffer ConfigIntake::start() {
    if (!setup_.factory_only) {
        if (!std::exchange(started_, true)) {
            memory_.judge();
            last_good_ = memory_.last_good(setup_.orders);
        }
        if (auto set = good_one_in_folder()) return offer(std::move(*set), ConfigSource::New);
        if (last_good_ && !contains(refused_, last_good_->hash) && !memory_.black_listed(last_good_->hash))
            return offer(*last_good_, ConfigSource::LastGood);
    }
    if (setup_.factory_only) report_.result = ConfigResult::NotRead;
    ConfigSet set = factory_set(setup_.orders);
    report_.stands_in = setup_.factory_only || report_.result != ConfigResult::Applied;
    if (contains(refused_, set.hash)) throw ConfigError(report_.errors);
    if (!set.good()) throw ConfigError(set.diagnostics);
    return offer(std::move(set), ConfigSource::Factory);
}

ConfigOffer ConfigIntake::offer(ConfigSet set, ConfigSource source) {
    ConfigOffer offer{set.hash, source, set.exhibit.exhibit, set.scene};
    if (in_force_) offer.exhibit = without_restart(*in_force_, set.exhibit.exhibit);
    if (const ConfigSet* before = running_ ? &*running_ : open_ ? &open_->set : nullptr) {
        const Exhibit& runs = before->exhibit.exhibit;
        offer.changes = changed_keys(runs, set.exhibit.exhibit);
        const bool renamed = std::any_of(offer.changes.begin(), offer.changes.end(),
                                         [](const KeyChange& c) { return c.key == "scene"; });
        if (!renamed && !same_scene_files(set.files, before->files))
            offer.changes.push_back(
                {"scene", TakesEffect::Scene, to_toml(runs.scene), to_toml(set.exhibit.exhibit.scene)});
    }
    overtaken_ = std::exchange(open_, Open{std::move(set), source});
    if (source == ConfigSource::New) {
        report_.result = ConfigResult::Trying;
        report_.errors.clear();
    }
    return offer;
}

void ConfigIntake::building(const std::string& hash) {
    if (!open_ || open_->set.hash != hash) return;
    overtaken_.reset();
    if (!in_force_) in_force_ = open_->set.exhibit.exhibit;
    blame(is_proven(*open_) ? "" : hash);
}

bool ConfigIntake::is_proven(const Open& open) const {
    return open.source != ConfigSource::New || open.set.hash == memory_.last_good_hash();
}

/// Should the program die from now on, it is for this one; empty: for none that is known.
void ConfigIntake::blame(const std::string& hash) {
    if (memory_.on_probation() == hash) return;
    if (hash.empty())
        memory_.end_probation();
    else
        memory_.begin_probation(hash);
}

void ConfigIntake::accepted(const std::string& hash, Instant now) {
    if (!open_ || open_->set.hash != hash) return;
    building(hash);
    Exhibit& exhibit = open_->set.exhibit.exhibit;
    report_.pending_restart.clear();
    for (KeyChange& change : changed_keys(*in_force_, exhibit))
        if (change.takes_effect > TakesEffect::Scene) report_.pending_restart.push_back(std::move(change));
    exhibit = without_restart(*in_force_, exhibit);
    in_force_ = exhibit;
    const bool proven = is_proven(*open_);
    probation_until_ = proven ? std::nullopt : std::optional(now + kProbation);
    const ConfigSource source = open_->source;
    running_ = std::move(open_->set);
    open_.reset();
    if (source == ConfigSource::New && hash == report_.hash) report_.result = ConfigResult::Applied;
    report_.source = source;
    report_.stands_in &= source == ConfigSource::Factory || !report_.pending_restart.empty();
    report_.stop_unread &= source == ConfigSource::LastGood || !report_.pending_restart.empty();
    report_.running_hash = hash;
    report_.applied_at = utc_stamp();
    report_.probation = !proven;
    ++report_.applied;
    publish();
}

void ConfigIntake::refused(const std::string& hash, const std::string& reason) {
    if (!open_ || open_->set.hash != hash) return;
    refused_.push_back(hash);
    const bool in_folder = open_->source == ConfigSource::New;
    open_ = std::exchange(overtaken_, std::nullopt);
    if (memory_.on_probation() == hash) blame(probation_until_ ? report_.running_hash : "");
    const Diagnostic blame = of_folder(setup_.folder, reason);
    if (in_folder)
        refuse(ConfigResult::Refused, {blame});
    else
        report_.errors.push_back(blame);
    publish();
}

void ConfigIntake::stopped() {
    if (keeping_.valid()) keeping_.wait();
    blame("");
    probation_until_.reset();
}

std::optional<ConfigOffer> ConfigIntake::consider(ConfigSet set) {
    watch(set);
    if (set.hash == report_.hash) return std::nullopt;
    report_.hash = set.hash;
    if (auto why = objection(set)) {
        refuse(why->result, std::move(why->errors));
    } else if (open_ && set.hash == open_->set.hash) {
        report_.result = ConfigResult::Trying;  // what is being built is back
        report_.errors.clear();
    } else if (set.hash != report_.running_hash || report_.source == ConfigSource::LastGood) {
        ConfigOffer made = offer(std::move(set), ConfigSource::New);
        publish();
        return made;
    } else {
        report_.result = ConfigResult::Applied;  // what runs is back
        report_.errors.clear();
    }
    publish();
    return std::nullopt;
}

std::optional<ConfigOffer> ConfigIntake::poll(Instant now) {
    if (setup_.factory_only) return std::nullopt;
    // Panel, hand and screen were opened as start() said, whatever comes before the first scene is built.
    if (!in_force_ && open_) in_force_ = open_->set.exhibit.exhibit;
    if (is_ready(keeping_)) {
        keeping_.get();
        publish();
    }
    if (keeping_.valid()) return std::nullopt;
    if (probation_until_ && now >= *probation_until_ && !open_) {
        probation_until_.reset();
        report_.probation = false;
        const bool whole = report_.pending_restart.empty();
        busy_since_ = now;
        keeping_ = beside([this, whole] {
            if (whole) memory_.keep_as_last_good(*running_);
            memory_.end_probation();
        });
        return std::nullopt;
    }

    const FolderWatch::News news = watch_.poll(now);
    if (news.changed) quiet_until_ = now + kQuiet;
    if (open_ && running_) return std::nullopt;
    if (is_ready(reading_)) {
        ConfigSet set = reading_.get();
        // Written to while it was read: the next reading counts.
        if (!quiet_until_) return consider(std::move(set));
    }
    if (quiet_until_ && now >= *quiet_until_ && !news.writing && !reading_.valid()) {
        quiet_until_.reset();
        busy_since_ = now;
        reading_ = beside(
            [folder = setup_.folder, orders = setup_.orders] { return read_config_set(folder, orders); });
    }
    return std::nullopt;
}

bool ConfigIntake::is_held_up(Instant now) const {
    return now - busy_since_ > kHeldUp && (is_under_way(reading_) || is_under_way(keeping_));
}

void ConfigIntake::watch(const ConfigSet& set) {
    std::vector<std::filesystem::path> folders{setup_.folder, setup_.folder / "conf.d"};
    const auto add = [&folders](const std::filesystem::path& file) {
        std::error_code none;
        folders.push_back(std::filesystem::absolute(file).parent_path());
        // What a link leads to is written to where it lies.
        if (const auto real = std::filesystem::canonical(file, none); !none)
            folders.push_back(real.parent_path());
    };
    for (const auto* files : {&set.files.exhibit.own, &set.files.scene, &set.files.refers})
        for (const WrittenFile& file : *files) add(file.path);
    // One that is missing may come.
    for (const Diagnostic& d : set.diagnostics)
        if (d.file.find('/') != std::string::npos && d.line == 0) add(d.file);
    watch_.watch(std::move(folders));
}

void ConfigIntake::publish() {
    report_.unreadable_state = memory_.unreadable();
    report_.failed_writes = memory_.failed_writes();
    report_.trouble = memory_.trouble();
    std::vector<std::filesystem::path> folders;
    std::filesystem::path run_dir = setup_.run_dir;
    if (run_dir.empty() && running_) run_dir = running_->exhibit.exhibit.run_dir;
    if (is_folder(run_dir)) {
        std::error_code none;
        std::filesystem::create_directory(run_dir / "status", none);
        folders.push_back(run_dir / "status");
    }
    if (is_folder(setup_.folder / "status")) folders.push_back(setup_.folder / "status");
    write_config_report(folders, report_);
}

}  // namespace eddy
