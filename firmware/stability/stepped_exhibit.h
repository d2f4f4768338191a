#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "firmware/haptic/loop.h"
#include "firmware/show.h"

namespace eddy::stability {

/// The exhibit on virtual time and one thread: the show, and the 1 kHz loop of what is in the hand.
class SteppedExhibit {
  public:
    /// `hand` may be null: nobody is there. It must outlive this.
    SteppedExhibit(gles::Gpu& gpu, const Scene& scene, HapticDevice* hand,
                   const ForceFilterSettings& filter = {});

    /// What the loop is told from now on.
    void order(const HapticOrders& orders) { exchange_.orders.publish(orders); }
    const HapticOrders& orders() const { return orders_; }
    /// A tick of the loop. `now` never goes back.
    void tick(Instant now);
    /// The fluid's last answer reaches the hand, and a step of dt that ends at `now` is begun.
    void update(Instant now, Seconds dt);

    /// The ticks since the last call.
    const std::vector<TickRecord>& ticks();
    /// The newest answer of the fluid.
    FluidSnapshot answer() { return exchange_.fluid.newest(); }
    const LoopReport& report() { return exchange_.report.newest(); }
    const Show& show() const { return show_; }

  private:
    HapticExchange exchange_;
    Show show_;
    HapticOrders orders_;  ///< those of the scene
    TickTrace trace_{4000};
    std::optional<HapticLoop> loop_;
    std::vector<TickRecord> ticks_;
};

}  // namespace eddy::stability
