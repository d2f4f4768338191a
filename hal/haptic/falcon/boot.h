#pragma once
#include <cstdint>
#include <span>

#include "hal/haptic/falcon/ftdi.h"
#include "hal/haptic/falcon/transport.h"

namespace eddy::falcon {

/// Starts a cold Falcon: wakes its PIC, lets the DSP's boot ROM find the rate, and uploads the firmware,
/// which the DSP echoes byte by byte (order as in libnifalcon FalconCommLibUSB.cpp setFirmwareMode). Each
/// step has its own deadline.
class Boot {
  public:
    /// The image must outlive this.
    Boot(Transport& transport, std::span<const std::uint8_t> image) : transport_(transport), image_(image) {}

    void start(Instant now);
    /// Done: all of the image was echoed as sent. Failed: a step missed its deadline or an echo differed.
    Progress poll(Instant now);
    /// The upload itself has begun.
    bool uploading() const { return step_ == Step::Uploading || step_ == Step::Settling; }
    /// Uploads that ended because a byte came back other than it was sent.
    std::uint64_t wrong_echoes() const { return wrong_echoes_; }

  private:
    enum class Step { Configuring, Calling, Switching, FindingRate, Uploading, Settling };

    Progress configure(Instant now);
    Progress call(Instant now);
    Progress switch_over(Instant now);
    Progress find_rate(Instant now);
    Progress upload(Instant now);
    Progress settle(Instant now) const;
    Progress waiting(Instant now, Progress requests) const;

    void enter(Step step, Instant deadline);
    void ask(Instant now);
    void send_chunk(Instant now);
    /// Hands every byte that came in to `take`; stops and returns false as soon as `take` does.
    template <typename Take>
    bool take_bytes(Take take);

    Transport& transport_;
    std::span<const std::uint8_t> image_;
    Step step_ = Step::Configuring;
    Instant deadline_{0};
    RequestList requests_;
    int calls_ = 0;
    std::size_t matched_ = 0;  // bytes of the PIC's answer seen in a row
    std::size_t sent_ = 0;     // bytes of the image
    std::size_t echoed_ = 0;
    std::uint64_t wrong_echoes_ = 0;
};

}  // namespace eddy::falcon
