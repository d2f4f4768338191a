// The emulated Falcon on a unix socket, for a guest that speaks usb-redir.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <fstream>
#include <iterator>

#include "hal/haptic/emulated/person_motion.h"
#include "hal/haptic/emulated/recorded_motion.h"
#include "tests/redir/falcon_peer.h"
#include "tests/redir/redir_server.h"

namespace {

using namespace eddy;

redir::RedirServer* running = nullptr;
void stop(int) {
    if (running) running->stop();
}

std::unique_ptr<emulated::HandMotion> path_from(const std::string& motion, const std::string& axes,
                                                std::uint64_t seed) {
    if (motion == "person")
        return std::make_unique<emulated::PersonMotion>(emulated::PersonSettings{.seed = seed});
    std::ifstream file(motion, std::ios::binary);
    if (!file) throw std::runtime_error(fmt::format("cannot read {}", motion));
    const std::string csv{std::istreambuf_iterator<char>(file), {}};
    return std::make_unique<emulated::RecordedMotion>(csv, motion, emulated::AxisMap(axes),
                                                      emulated::AtEnd::Loop);
}

}  // namespace

int main(int argc, char** argv) {
    std::string socket, log_file, motion = "person", axes = "x,y,z";
    redir::FalconPeerSettings settings;
    std::uint64_t seed = 1;
    bool cold = false, unhomed = false, nobody_homes = false;
    CLI::App app{
        "The emulated Novint Falcon, with a hand on it, on a unix socket (usb-redir). Commands, one a line "
        "on standard "
        "input: hold X Y Z, follow, let-go, home, press N [MS], release N, silent TIME, hang TIME, "
        "power-loss, unplug, "
        "plug, cut, quit."};
    app.add_option("--socket", socket, "where to listen")->required();
    app.add_option("--log", log_file, "JSON lines of what happens; without it, standard output");
    app.add_option("--motion", motion, "the hand's path: person, or a recording (CSV: t_s,x_m,y_m,z_m)");
    app.add_option("--motion-axes", axes, "which axes of the recording are x, y and z");
    app.add_option("--seed", seed, "of the person");
    app.add_option("--serial", settings.serial, "of the device")->check([](const std::string& text) {
        return text.size() <= 100 ? std::string() : std::string("at most 100 letters");
    });
    app.add_flag("--cold", cold, "no firmware runs in it yet");
    app.add_flag("--unhomed", unhomed, "its firmware runs, but has not found its index marks")
        ->excludes("--cold");
    app.add_flag("--nobody-homes", nobody_homes, "the hand does not home the handle when it is asked to");
    CLI11_PARSE(app, argc, argv);
    try {
        if (cold) settings.start = emulated::BoardState::Cold;
        if (unhomed) settings.start = emulated::BoardState::RunUnhomed;
        settings.homes = !nobody_homes;
        redir::EventLog log(log_file);
        redir::FalconPeer peer(path_from(motion, axes, seed), settings);
        redir::RedirServer server(peer, socket, log);
        running = &server;
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, stop);
        server.run(STDIN_FILENO);
        running = nullptr;
    } catch (const std::exception& e) {
        fmt::print(stderr, "redir_falcon: {}\n", e.what());
        return 1;
    }
    return 0;
}
