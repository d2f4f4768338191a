#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "tests/redir/redir_guest.h"
#include "tests/redir/redir_host.h"

namespace eddy::redir {

/// A host and a guest with nothing but their bytes between them, on virtual time.
struct Wire {
    explicit Wire(UsbPeer& peer) : host(peer, true) { carry(); }

    /// Everything said is heard.
    void carry() {
        for (int i = 0; i < 4; ++i) {
            host.receive(guest.take_output());
            guest.receive(host.take_output());
        }
    }
    void run(Instant time, Instant step = std::chrono::microseconds(100)) {
        for (const Instant end = now + time; now < end; now += step) {
            carry();
            host.poll(now);
            carry();
        }
    }
    /// The answer, if it comes in this time.
    std::optional<RedirGuest::Answer> wait(std::uint64_t id,
                                           Instant at_most = std::chrono::milliseconds(50)) {
        for (const Instant end = now + at_most; now < end;) {
            run(std::chrono::microseconds(100));
            if (auto answer = guest.take(id)) return answer;
        }
        return std::nullopt;
    }

    Instant now{0};
    RedirHost host;
    RedirGuest guest;
};

}  // namespace eddy::redir
