#include "firmware/exhibit/visitors.h"

#include <algorithm>

namespace eddy {

Visitors::News Visitors::see(Instant now, Instant untouched) {
    News news;
    const Instant touch = now - untouched;
    const bool touched = touch > last_touch_;
    last_touch_ = std::max(last_touch_, touch);
    if (presence_ == Presence::Nobody) {
        if (!touched) return news;
        presence_ = Presence::Here;
        first_touch_ = last_touch_;
        news.came = true;
    }
    const Seconds quiet = now - last_touch_;
    if (quiet >= idle_after_) {
        presence_ = Presence::Nobody;
        news.gone = true;
        news.dwell = last_touch_ - first_touch_;
    } else if (quiet >= idle_after_ - std::min(kWarning, idle_after_ / 2)) {
        presence_ = Presence::Leaving;
    } else {
        presence_ = Presence::Here;
    }
    return news;
}

}  // namespace eddy
