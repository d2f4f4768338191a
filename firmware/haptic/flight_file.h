#pragma once
#include <string>
#include <string_view>

#include "firmware/haptic/flight.h"

namespace eddy {

/// A flight as text: a line for each tick, and one for each new answer of the fluid and each new order before it. Numbers are
/// written so that they are read as the same bits. What the law had in mind at the start is its bytes, as 64-bit Linux lays
/// them out; whoever changes the law changes them, so a file is rerun by the version that wrote it.
std::string flight_text(const Flight& flight);
/// What the last line of a flight says of all lines before it.
std::uint64_t flight_sum(std::string_view lines);

/// `name` for what is said of it. Throws InputError, with the line, if it is no flight, was cut off or changed, is that of another
/// version of the program, or has a state that rerun() could not go on from.
Flight read_flight(std::string_view text, const std::string& name);

}  // namespace eddy
