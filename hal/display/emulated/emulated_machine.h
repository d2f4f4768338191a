#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal/display/emulated/emulated_card.h"

namespace eddy::emulated {

/// A machine with graphics cards, for a KmsDisplay; the test that made it plays the people around it: pulls plugs, takes the
/// screen, stops the flips, lets time pass.
class ScreenMachine {
  public:
    ScreenMachine();

    /// To be given to a KmsDisplay; any number.
    std::unique_ptr<kms::Machine> machine() const;
    GraphicsCard& card(std::size_t i = 0) const { return *world_->cards.at(i); }
    GraphicsCard& add_card();
    /// As when a plug changes and the kernel says so.
    void tell_of_plugs() const { world_->plugs_changed = true; }
    void wait(Instant time) const;
    Instant now() const { return world_->now; }
    bool console_text() const { return world_->console_text; }

    struct World {
        std::vector<std::shared_ptr<GraphicsCard>> cards;
        bool plugs_changed = false, console_text = true;
        int next_fd = 3;
        Instant now{0};
    };

  private:
    std::shared_ptr<World> world_;
};

}  // namespace eddy::emulated
