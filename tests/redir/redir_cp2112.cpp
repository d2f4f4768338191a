// An emulated CP2112 USB-GPIO bridge on a unix socket, for a guest that speaks usb-redir.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>

#include "tests/redir/cp2112.h"
#include "tests/redir/redir_server.h"

namespace {

eddy::redir::RedirServer* running = nullptr;
void stop(int) {
    if (running) running->stop();
}

}  // namespace

int main(int argc, char** argv) {
    std::string socket, log_file;
    CLI::App app{
        "An emulated CP2112 USB-GPIO bridge on a unix socket (usb-redir). Commands, one a line on standard "
        "input: "
        "low N, high N, press N MS, unplug, plug, cut, quit."};
    app.add_option("--socket", socket, "where to listen")->required();
    app.add_option("--log", log_file, "JSON lines of what happens; without it, standard output");
    CLI11_PARSE(app, argc, argv);
    try {
        eddy::redir::EventLog log(log_file);
        eddy::redir::Cp2112 peer;
        eddy::redir::RedirServer server(peer, socket, log);
        running = &server;
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, stop);
        server.run(STDIN_FILENO);
        running = nullptr;
    } catch (const std::exception& e) {
        fmt::print(stderr, "redir_cp2112: {}\n", e.what());
        return 1;
    }
    return 0;
}
