#include "tests/redir/redir_server.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "tests/redir/cp2112.h"
#include "tests/redir/redir_guest.h"
#include "tests/scratch_folder.h"

// Real sockets, real time, patient.

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;

/// A guest on the socket.
class Caller {
  public:
    explicit Caller(const std::string& path) : fd_(socket(AF_UNIX, SOCK_STREAM, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.copy(address.sun_path, sizeof(address.sun_path) - 1);
        connected_ = connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
        const timeval at_most{0, 5000};
        setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &at_most, sizeof(at_most));
    }
    ~Caller() { close(fd_); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    bool connected() const { return connected_; }
    bool closed() const { return closed_; }
    void say(std::span<const std::uint8_t> bytes) {
        static_cast<void>(!::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
    }
    template <typename Done>
    bool until(Done done) {
        for (const auto end = std::chrono::steady_clock::now() + 20s;
             std::chrono::steady_clock::now() < end;) {
            say(guest.take_output());
            std::array<std::uint8_t, 4096> bytes{};
            const auto size = recv(fd_, bytes.data(), bytes.size(), 0);
            if (size == 0) closed_ = true;
            if (size > 0) guest.receive({bytes.data(), static_cast<std::size_t>(size)});
            if (done()) return true;
        }
        return false;
    }

    RedirGuest guest;

  private:
    int fd_;
    bool connected_ = false;
    bool closed_ = false;
};

struct RedirServerTest : testing::Test {
    ScratchFolder folder;
    const std::string socket = folder / "s";
    const std::string log_file = folder / "log";
    Cp2112 peer;
    EventLog log{log_file};
    std::unique_ptr<RedirServer> server = std::make_unique<RedirServer>(peer, socket, log);
    int pipe_[2] = {-1, -1};
    std::thread thread;

    void SetUp() override {
        ASSERT_EQ(pipe(pipe_), 0);
        thread = std::thread([this] { server->run(pipe_[0]); });
    }
    void TearDown() override {
        server->stop();
        thread.join();
        close(pipe_[0]);
        close(pipe_[1]);
    }
    void command(const std::string& line) {
        static_cast<void>(!write(pipe_[1], (line + "\n").data(), line.size() + 1));
    }
    std::string log_text() const {
        std::ifstream file(log_file);
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

TEST_F(RedirServerTest, ServesOneGuestAfterTheOther) {
    for (int i = 0; i < 3; ++i) {
        Caller caller(socket);
        ASSERT_TRUE(caller.connected());
        EXPECT_TRUE(caller.until([&] { return caller.guest.device.has_value(); }));
    }
}

TEST_F(RedirServerTest, HangsUpOnNonsenseAndServesTheNext) {
    Caller nonsense(socket);
    nonsense.say(std::vector<std::uint8_t>(400, 0x55));
    EXPECT_TRUE(nonsense.until([&] { return nonsense.closed(); }));
    Caller caller(socket);
    EXPECT_TRUE(caller.until([&] { return caller.guest.device.has_value(); }));
}

TEST_F(RedirServerTest, ObeysItsCommandsAndSaysSo) {
    Caller caller(socket);
    ASSERT_TRUE(caller.until([&] { return caller.guest.device.has_value(); }));
    command("low 3");
    command("nonsense");
    command("unplug");
    EXPECT_TRUE(caller.until([&] { return caller.guest.disconnections == 1; }));
    command("plug");
    EXPECT_TRUE(caller.until([&] { return caller.guest.device.has_value(); }));
    command("cut");
    EXPECT_TRUE(caller.until([&] { return caller.closed(); }));
    Caller other(socket);
    EXPECT_TRUE(other.until([&] { return other.guest.device.has_value(); }));
    command("quit");
    thread.join();
    const std::string text = log_text();
    std::map<std::string, int> events;
    for (std::size_t from = 0, end; (end = text.find('\n', from)) != std::string::npos; from = end + 1) {
        const auto line = nlohmann::json::parse(text.substr(from, end - from));
        ++events[line["event"]];
        if (line["event"] == "command") {
            EXPECT_EQ(line["answer"] == "ok", line["line"] != "nonsense") << line;
        }
    }
    EXPECT_EQ(events["command"], 6);
    EXPECT_EQ(events["attached"], 3);
    EXPECT_GE(events["detached"], 2);
    EXPECT_GE(events["lines"], 1);
    thread = std::thread([] {});
}

TEST_F(RedirServerTest, TakesASocketFromADeadProgramAndNotFromALivingOne) {
    EXPECT_THROW(RedirServer(peer, socket, log), std::runtime_error);
    Caller caller(socket);
    EXPECT_TRUE(caller.until([&] { return caller.guest.device.has_value(); })) << "the first one lives on";
    // What a killed program leaves.
    const std::string left = folder / "left";
    const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    left.copy(address.sun_path, sizeof(address.sun_path) - 1);
    ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    close(fd);
    Cp2112 second;
    EXPECT_NO_THROW(RedirServer(second, left, log));
}

}  // namespace
}  // namespace eddy::redir
