#pragma once
#include <cstdint>
#include <optional>

#include "hal/haptic/falcon/ftdi.h"
#include "hal/haptic/falcon/protocol.h"
#include "hal/haptic/falcon/transport.h"

namespace eddy::falcon {

/// Commands and replies over the transport: at most one command unanswered. When a reply stays out, the line
/// is purged and the next command may go.
///
/// Replies carry no number. One that was late rather than lost would pass for the answer to the next command, and
/// from then on every position would be old without anybody noticing; so would one that came twice. After either, the
/// line must once be quiet for longer than a reply takes, with nothing unanswered, and forces wait until replies are
/// on time again.
///
/// Of several replies that arrive by one poll the newest counts. Where the bytes of two travel one by one, so that the first is
/// complete a poll before the second, the first counts for a tick: what only the second says, lost homing too, is seen one
/// command late.
class Exchange {
  public:
    /// A reply takes about 1 ms; libnifalcon's users wait 5 to 20.
    static constexpr Instant kReplyTime = std::chrono::milliseconds(10);
    static constexpr Instant kQuietTime = std::chrono::milliseconds(15);
    /// So many replies in a row on time make the line trusted.
    static constexpr int kTimely = 5;

    explicit Exchange(Transport& transport) : transport_(transport) {}

    /// Forgets everything under way, but keeps the counters.
    void reset();
    /// Takes in what arrived. The newest reply, if any came.
    std::optional<Reply> poll(Instant now);
    /// A command may be sent: nothing is unanswered.
    bool free() const { return step_ == Step::Free && transport_.out() != Transfer::Pending; }
    /// Replies are on time, so that positions are new.
    bool trusted() const { return timely_ >= kTimely; }
    /// Only while free().
    void send(const Command& command, Instant now);

    /// When the last packet with (part of) the newest reply arrived.
    Instant reply_arrived_at() const { return reply_arrived_at_; }
    /// Commands without reply since the last reply.
    int misses() const { return misses_; }
    std::uint64_t dropped_bytes() const { return finder_.dropped(); }
    std::uint64_t line_faults() const { return line_faults_; }

  private:
    enum class Step { Free, Waiting, Purging, Quiet };

    void answered(int replies, Instant now);

    Transport& transport_;
    FrameFinder finder_;
    RequestList purge_;
    Step step_ = Step::Free;
    Instant deadline_{0};
    Instant reply_arrived_at_{0};
    int misses_ = 0;
    int timely_ = 0;
    bool doubtful_ = false;  // a reply stayed out or came unasked: the next one may be an old one
    std::uint64_t line_faults_ = 0;
};

}  // namespace eddy::falcon
