#pragma once
#include <filesystem>

#include "firmware/haptic/flight.h"

namespace eddy {

/// Draws a flight by gnuplot: force, handle, and how old what the loop knew was, over the seconds around the fault. False, said
/// on standard error, where gnuplot is missing or failed.
bool plot_flight(const Flight& flight, const std::filesystem::path& png);

}  // namespace eddy
