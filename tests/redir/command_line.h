#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/clock.h"

namespace eddy::redir {

/// The words of a command.
std::vector<std::string> words_of(std::string_view line);
/// A number, all of the text.
std::optional<double> number_in(const std::string& text);
/// A time such as 2s, 1.5s, 300ms; a number alone is milliseconds. 0 to an hour.
std::optional<Instant> time_in(const std::string& text);
/// The number of a line or button, 0 up to the last.
std::optional<unsigned> index_in(const std::string& text, unsigned last);

}  // namespace eddy::redir
