#include "firmware/exhibit/config_report.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "firmware/text_file.h"

namespace eddy {
namespace {

using Json = nlohmann::ordered_json;

// "what is wrong; what to write instead", as messages are worded.
Json json_of(const Diagnostic& d) {
    const std::size_t cut = d.message.find("; ");
    return {{"file", d.file},
            {"line", d.line},
            {"column", d.column},
            {"key", d.key},
            {"message", d.message.substr(0, cut)},
            {"hint", cut == std::string::npos ? "" : d.message.substr(cut + 2)}};
}

}  // namespace

std::string_view to_word(ConfigSource source) {
    switch (source) {
        case ConfigSource::New:
            return "new";
        case ConfigSource::LastGood:
            return "last-good";
        case ConfigSource::Factory:
            break;
    }
    return "factory";
}

std::string_view to_word(ConfigResult result) {
    switch (result) {
        case ConfigResult::Applied:
            return "applied";
        case ConfigResult::Trying:
            return "trying";
        case ConfigResult::Refused:
            return "refused";
        case ConfigResult::BlackListed:
            return "black-listed";
        case ConfigResult::NotRead:
            break;
    }
    return "not-read";
}

std::string to_json(const ConfigReport& r) {
    Json j{{"hash", r.hash},
           {"running_hash", r.running_hash},
           {"result", to_word(r.result)},
           {"source", to_word(r.source)},
           {"stands_in", r.stands_in},
           {"stop_unread", r.stop_unread},
           {"applied_at", r.applied_at.empty() ? Json() : Json(r.applied_at)},
           {"probation", r.probation},
           {"errors", Json::array()},
           {"pending_restart", Json::array()},
           {"applied", r.applied},
           {"refused", r.refused},
           {"unreadable_state", r.unreadable_state},
           {"failed_writes", r.failed_writes},
           {"trouble", r.trouble}};
    for (const Diagnostic& d : r.errors) j["errors"].push_back(json_of(d));
    for (const KeyChange& c : r.pending_restart)
        j["pending_restart"].push_back(
            {{"key", c.key}, {"takes_effect", to_word(c.takes_effect)}, {"from", c.from}, {"to", c.to}});
    // A message may quote bytes that are no UTF-8.
    return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_config_report(const std::vector<std::filesystem::path>& folders, const ConfigReport& report) {
    const std::string text = to_json(report);
    for (const std::filesystem::path& folder : folders) {
        try {
            replace_text_file(folder / "config.json", text);
        } catch (const std::runtime_error&) {  // full or gone
        }
    }
}

}  // namespace eddy
