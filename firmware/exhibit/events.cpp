#include "firmware/exhibit/events.h"

#include <fmt/format.h>

namespace eddy {
namespace {

constexpr EventKind kKinds[] = {
    {Event::Started, "started", "ebd74603bb9e4b66bf71ce7cf6122f36", Priority::Notice, "The program begins.",
     "Nothing."},
    {Event::FirstPicture, "first_picture", "25e8bb8e973094f42eee22892bf734e2", Priority::Notice,
     "The screen shows words, which move, while the fluid is being prepared; the line says how many seconds "
     "after "
     "the start of the program, as the field EDDY_AFTER_S does.",
     "Nothing."},
    {Event::Ready, "ready", "e23300ad060d4172a8b68f2a26d1190f", Priority::Notice,
     "The first frame of the show is on the screen; with the seconds since the start of the program, as "
     "above.",
     "Nothing."},
    {Event::Stopping, "stopping", "78f4a4ed5ce54fa2873fe880dc30d58b", Priority::Notice,
     "The button was held for ten seconds: the program ends, and the machine is switched off.",
     "Nothing, if you held it."},
    {Event::EndedBadly, "ended_badly", "0b0fd89bf13144f0ab0322253e0e2f0c", Priority::Warning,
     "The run before this one ended by itself: it crashed, or was ended because it hung.",
     "Look at the lines before, and whether there is a crash record in the state folder."},
    {Event::PowerCut, "power_cut", "2b66781d81b54743844604b285ad9304", Priority::Warning,
     "The machine went away under the run before this one.",
     "Nothing, if the hall's power is cut every evening: that is allowed. Else look at plug and power "
     "supply."},
    {Event::SafeMode, "safe_mode", "84379d95ec10449991c647d019a4790a", Priority::Error,
     "Safe mode: the settings of the factory, and no force; three restarts of the machine within an hour did "
     "not help, or the file `safe` in the state folder asks for it.",
     "Read what came before. When it is mended, remove that file, then switch the box off and on, or an hour "
     "later restart the service: it does not come back by itself."},
    {Event::Crashed, "crashed", "f20e9d2e06074a1c9e0ac6251c7df971", Priority::Error,
     "A record of a crash was found, with the last lines of the log and the last seconds of the hand.",
     "Keep the files it names and report them; `eddy replay` shows the seconds of the hand."},
    {Event::Hangs, "hangs", "623c1bc71d83410ea6e76b7f5a67b137", Priority::Error,
     "A part of the program does not get on; the service manager will end it and start it again. But if it "
     "is button and lamps, the show goes on, without force where a stop input is wired; and if it is files "
     "that the disk does not read or keep, the show goes on as it is.",
     "Report it, with the crash record of the next start. If it is button and lamps: unplug their USB "
     "bridge, plug it in again, and click. If it is files: look at the disk, or the network they lie on."},
    {Event::Opened, "opened", "8dbf1c6d504c49b89a07c09a8928c45f", Priority::Info, "The opening hours begin.",
     "Nothing."},
    {Event::Closed, "closed", "e26d5bcad92f40ba843f9eab28dac2ce", Priority::Info,
     "The opening hours end: no picture, no force.",
     "Nothing. If it should be open, look at [hours] in exhibit.toml, and at the machine's time zone."},
    {Event::ClockUnsure, "clock_unsure", "9d8184784833442785e43a0ff86307b7", Priority::Warning,
     "The machine's clock is not synchronised: the exhibit stays open at all hours.",
     "Give the machine a network or a time server (`timedatectl`)."},
    {Event::VisitBegan, "visit_began", "43b10d7428b74d9c822729739ed2734c", Priority::Info,
     "Somebody touched the handle after a time without anybody.", "Nothing."},
    {Event::VisitEnded, "visit_ended", "81e6b23a249344658bedd282370019a9", Priority::Info,
     "Nobody has touched the handle for a while.", "Nothing."},
    {Event::Reset, "reset", "ebf146e4d2934fe6ba8f6e4d9f8261e4", Priority::Info,
     "The scene began anew: nobody was there, or somebody asked for it.", "Nothing."},
    {Event::ConfigTaken, "config_taken", "3603ba2a6f294f6cb6ac7a5a75b72ea0", Priority::Notice,
     "Settings were read and taken.", "Nothing."},
    {Event::ConfigRejected, "config_rejected", "886e0f8bd64345399e5682ead3c32024", Priority::Error,
     "Settings were read and not taken; the show goes on with those before.",
     "The line names file, line and column, and so does status/config.json. Mend the file; `eddy "
     "check-config` tries it before."},
    {Event::ConfigFellBack, "config_fell_back", "96dcb19211bb4b27a01356e358a2e9af", Priority::Error,
     "The settings led to a failure: the last good ones, or those of the factory, are in force; with the "
     "factory's there is no "
     "force, for they know of no stop input.",
     "Mend the settings that were put aside; the line names them."},
    {Event::DeviceFound, "device_found", "23e09ae1d05e414d8fa1577cd2d53abc", Priority::Notice,
     "The haptic device is there and ready.", "Nothing."},
    {Event::DeviceLost, "device_lost", "ca9e2c22be3d404bb4c18c99b9d64c49", Priority::Warning,
     "The haptic device is gone or does not answer; the show goes on without it.",
     "Look at its cable and its power supply; `systemctl stop eddy`, then `eddy falcon` says what it waits "
     "for."},
    {Event::ForceOff, "force_off", "f5a90ced5acd4e2689ddd51c35abdcb3", Priority::Warning,
     "The force was taken away; the line says why.",
     "A stop input waits for its restart; else see status.json and the recording of the seconds before."},
    {Event::FlightKept, "flight_kept", "e52bf3dfcad446648682530aeac18e04", Priority::Warning,
     "The seconds before a fault of the hand were kept.", "`eddy replay` tells them."},
    {Event::QualityChanged, "quality_changed", "71cad9c87b764ff49b93cc89638c30e6", Priority::Info,
     "The fluid is computed more, or less, exactly from now on.",
     "Nothing; if it is too often, stop the show: `eddy tune` measures the machine."},
    {Event::ScreenLost, "screen_lost", "7addf5fdc6eb4a8daa274b01029ebec6", Priority::Warning,
     "No screen, or none that takes a picture.", "Look at screen and cable; it is tried again by itself."},
    {Event::ScreenFound, "screen_found", "c1bdf0e2018a4176a9ccb2caf77446c5", Priority::Notice,
     "A screen is there.", "Nothing."},
    {Event::GpuReset, "gpu_reset", "ad950bc4f9bd4123a0edb756fbb71001", Priority::Error,
     "The graphics driver lost all that was drawn; it is made anew.",
     "If it happens again, look at the machine's cooling and the driver's own lines in the log."},
    {Event::DiskTrouble, "disk_trouble", "b877d9033efd49e0a3b9ce9fb4aa662e", Priority::Error,
     "Something could not be written; the show goes on.", "Look whether the disk is full or broken."},
    {Event::Screenshot, "screenshot", "8ea6f10be3db4eeb958ea1d5d4a12977", Priority::Info,
     "A picture of the screen was asked for and written.", "Nothing."},
    {Event::Note, "note", "83d1be80aa244427a7adb5f4472ff4f5", Priority::Info, "Anything else worth a line.",
     "Read it."},
};

/// The table is in the order of the enumeration: kind_of() finds by number.
constexpr bool in_order() {
    for (std::size_t i = 0; i < std::size(kKinds); ++i)
        if (kKinds[i].event != static_cast<Event>(i)) return false;
    return std::size(kKinds) == static_cast<std::size_t>(Event::Note) + 1;
}
static_assert(in_order());

constexpr std::string_view name_of(Priority priority) {
    switch (priority) {
        case Priority::Error:
            return "error";
        case Priority::Warning:
            return "warning";
        case Priority::Notice:
            return "notice";
        case Priority::Info:
            return "info";
    }
    return "?";
}

}  // namespace

std::span<const EventKind> event_kinds() {
    return kKinds;
}

const EventKind& kind_of(Event event) {
    return kKinds[static_cast<std::size_t>(event)];
}

std::string log_reference() {
    std::string text =
        "# What the log says\n\n"
        "`journalctl -u eddy` shows all of it. Every line is of one of these kinds, and carries its name "
        "(EDDY_EVENT) and id "
        "(MESSAGE_ID),\n"
        "neither of which ever changes: `journalctl EDDY_EVENT=device_lost` finds all of a kind, `journalctl "
        "-u eddy -p err` "
        "what needs\n"
        "somebody. Lines also carry CONFIG_HASH, which settings were in force. The same line again within a "
        "minute is counted, "
        "not printed.\n\n"
        "| event | priority | what it means | what to do | MESSAGE_ID |\n|---|---|---|---|---|\n";
    for (const EventKind& kind : kKinds)
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", kind.name, name_of(kind.priority), kind.meaning,
                            kind.what_to_do, kind.id);
    return text;
}

}  // namespace eddy
