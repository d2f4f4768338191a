#pragma once
#include <memory>
#include <optional>
#include <string>

#include "firmware/exhibit/act.h"
#include "firmware/exhibit/hand_side.h"

namespace eddy {

/// Which act is played, and which comes next. GL thread only.
class Playbill {
  public:
    Playbill(gles::Gpu& gpu, HandSide& hand) : gpu_(gpu), hand_(hand) {}

    /// Another act is to follow, when it is ready. One that was announced before and does not play yet is forgotten.
    void announce(const Scene& scene, Act::Setup setup);
    bool something_announced() const { return announced_.has_value(); }

    struct News {
        bool began = false;       ///< the act announced plays from now on,
        Seconds prepared{0.0};    ///< after so much time of this thread,
        std::string failed = {};  ///< or cannot, for this reason: the one before plays on
    };
    /// A piece of what makes the announced act ready; it begins with the last one. A piece may take long: `meanwhile`, if any, is
    /// called in the middle of it, often, and may draw; if it returns false, what there is of the act is given up, and the next
    /// call begins anew.
    std::optional<News> work(const std::function<bool()>& meanwhile = {});
    /// Which share of the pieces is done.
    double prepared() const;

    bool plays() const { return act_ != nullptr; }
    Act& act() { return *act_; }
    const Act& act() const { return *act_; }

  private:
    bool prepare_a_piece();

    gles::Gpu& gpu_;
    HandSide& hand_;
    struct Announced {
        Scene scene;
        Act::Setup setup;
        Seconds prepared{0.0};
    };
    std::optional<Announced> announced_;
    std::unique_ptr<Act> act_, next_;
};

}  // namespace eddy
