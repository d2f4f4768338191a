#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "hal/display/kms/card.h"

namespace eddy::kms {

/// What a card showed before anything was changed, to be put back at the end.
class FoundState {
  public:
    explicit FoundState(Card& card);
    /// On these CRTCs. What cannot be put back, for its picture is gone, is switched off: then the kernel's console comes back when
    /// the card is closed.
    void put_back(Card& card, const std::set<std::uint32_t>& crtcs) const;

  private:
    std::vector<Crtc> crtcs_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> connectors_;  ///< by the CRTC that drives them
};

}  // namespace eddy::kms
