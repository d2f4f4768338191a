#include "firmware/screen_report.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "hal/display/kms/monitor.h"

namespace eddy {
namespace {

const char* to_word(kms::Connection c) {
    return c == kms::Connection::Connected      ? "connected"
           : c == kms::Connection::Disconnected ? "nothing connected"
                                                : "cannot tell whether anything is connected";
}

std::string modes_of(const kms::Monitor& monitor) {
    std::string text;
    for (const drmModeModeInfo& mode : monitor.modes) {
        const std::string one = kms::describe(mode);
        if (text.find(one) != text.npos) continue;
        text += fmt::format("{}{}{}", text.empty() ? "" : ", ", one,
                            (mode.type & DRM_MODE_TYPE_PREFERRED) != 0 ? " (preferred)" : "");
    }
    return text;
}

}  // namespace

ScreenReport report_screens(kms::Machine& machine, const kms::Wish& wish) {
    ScreenReport report;
    const auto say = [&report](const std::string& line) { report.text += line + "\n"; };
    const std::vector<std::string> paths = machine.cards();
    if (paths.empty())
        say("no graphics card that could drive a screen: there is no /dev/dri/card*; lspci -k names the "
            "card's driver");
    bool chosen_one = false;
    for (const std::string& path : paths) {
        const kms::Machine::Opened opened = machine.open(path);
        if (!opened.card) {
            say(fmt::format("{}: {}{}", path, std::strerror(opened.error),
                            opened.error == EACCES
                                ? "; add this user to the group that owns it: usermod -aG video USER"
                                : ""));
            continue;
        }
        const bool atomic = opened.card->enable_atomic();
        const bool master = opened.card->is_master() || opened.card->take_master() == 0;
        const std::vector<kms::Monitor> monitors = kms::look_for_monitors(*opened.card, true);
        say(fmt::format("{}: {}, {}", path, monitors.empty() ? "no plug for a screen" : "drives screens",
                        atomic ? "atomic commits" : "older calls only"));
        if (!master) {
            const std::string who = machine.holders(path);
            say(fmt::format("  the screen is held by {}",
                            who.empty() ? "another program; as root this names it" : who));
        }
        const auto chosen = kms::choose_monitor(monitors, wish);
        for (std::size_t i = 0; i < monitors.size(); ++i) {
            const kms::Monitor& m = monitors[i];
            say(fmt::format("  {}: {}{}{}", m.plug, to_word(m.connection),
                            m.name.empty() ? "" : fmt::format(": {} ({})", m.name, m.id),
                            m.link_bad ? "; its link is bad: try another cable" : ""));
            if (m.connection == kms::Connection::Connected && m.id.empty())
                say("    it does not say who it is (no EDID): if the picture is wrong, set screen.mode");
            if (!m.modes.empty()) say("    modes " + modes_of(m));
            if (!chosen || chosen->index != i || chosen_one) continue;
            chosen_one = true;
            report.usable = master;
            const kms::ChosenMode mode = kms::choose_modes(m, wish).front();
            say(fmt::format("    would be used: {}", chosen->why));
            say(fmt::format("    in {}: {}", kms::describe(mode.mode), mode.why));
        }
    }
    if (!paths.empty() && !chosen_one)
        say(wish.connector.empty()
                ? "no screen would be used: nothing is connected; a plug that cannot tell can be named in "
                  "screen.connector"
                : fmt::format(
                      "no screen would be used: nothing is connected to {}, which screen.connector names",
                      wish.connector));
    return report;
}

}  // namespace eddy
