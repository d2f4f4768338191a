#include "firmware/exhibit/lamps.h"

namespace eddy {
namespace {

char letter(std::string_view pattern, Instant shown) {
    return pattern[static_cast<std::size_t>(shown / kLampStep) % pattern.size()];
}

constexpr bool is_one_of(char letter, std::string_view letters) {
    return letters.find(letter) != std::string_view::npos;
}

constexpr bool rows_are_in_order() {
    for (std::size_t i = 0; i < kLampRows.size(); ++i)
        if (kLampRows[i].code != static_cast<LampCode>(i)) return false;
    return true;
}
static_assert(rows_are_in_order());

}  // namespace

LampStates lamps(LampCode code, Instant shown) {
    const char now = letter(row_of(code).three, shown);
    return {.green = is_one_of(now, "G*"), .amber = is_one_of(now, "A*"), .red = is_one_of(now, "R*")};
}

bool lamp(LampCode code, Instant shown) {
    return letter(row_of(code).one, shown) == '*';
}

HandleLight ring(LampCode code, Instant shown) {
    const char now = letter(row_of(code).ring, shown);
    return {.red = is_one_of(now, "RYW"), .green = is_one_of(now, "GYCW"), .blue = is_one_of(now, "BCW")};
}

void LampPlayer::advance(Instant now) {
    if (!began_) since_ = now;
    began_ = true;
    const Instant before = shown_;
    shown_ = (now - since_) / kLampStep * kLampStep;
    // Only at the end of a step, so that what is lit has been for a whole one.
    if (wanted_ == code_ || shown_ == before) return;
    code_ = wanted_;
    since_ = now;
    shown_ = Instant(0);
}

}  // namespace eddy
