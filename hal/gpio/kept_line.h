#pragma once
#include <optional>

#include "hal/clock.h"
#include "hal/gpio/gpio.h"

namespace eddy {

/// A line that may go away, as on a USB bridge that somebody unplugs, and is taken back when it returns. Throws nothing. One
/// thread.
class KeptLine {
  public:
    /// While it is away it is looked for so often.
    static constexpr Instant kRetry = std::chrono::seconds(1);
    /// Who asks more seldom than this is told of a tap that came and went meanwhile. Else a finger is still there when the edge is
    /// looked after, and what is not is a spark.
    static constexpr Instant kLate = std::chrono::milliseconds(30);
    /// An output is said again so often, to find out that it is away.
    static constexpr Instant kSayAgain = std::chrono::seconds(1);

    /// `gpio` must outlive it. An empty address: no line, and no trouble.
    KeptLine(Gpio& gpio, std::string address, const GpioWish& wish);

    bool wanted() const { return !address_.empty(); }
    /// Whether it is active, or was since it was asked before if that is long ago; nothing while it is away.
    std::optional<bool> read(Instant now);
    void write(Instant now, bool active);
    /// As GpioLine::edges_fd(); -1 too while it is away.
    int edges_fd() const { return line_ ? line_->edges_fd() : -1; }

    /// Why it is away, in a sentence; empty while it is there.
    const std::string& trouble() const { return trouble_; }

  private:
    bool is_there(Instant now);
    void lose(Instant now, const char* why);

    Gpio& gpio_;
    std::string address_;
    GpioWish wish_;
    std::unique_ptr<GpioLine> line_;
    std::optional<Instant> tried_at_;
    Instant read_at_{0};
    std::optional<bool> written_;
    Instant written_at_{0};
    std::string trouble_;
};

}  // namespace eddy
