#include "tests/redir/command_line.h"

#include <charconv>
#include <cmath>

namespace eddy::redir {

std::vector<std::string> words_of(std::string_view line) {
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
        words.emplace_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

std::optional<double> number_in(const std::string& text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

std::optional<Instant> time_in(const std::string& text) {
    const auto without = [&text](std::string_view unit) -> std::optional<double> {
        if (!text.ends_with(unit)) return std::nullopt;
        return number_in(text.substr(0, text.size() - unit.size()));
    };
    std::optional<double> seconds = without("s");
    if (const auto ms = text.ends_with("ms") ? without("ms") : number_in(text)) seconds = *ms / 1000.0;
    if (!seconds || *seconds < 0.0 || *seconds > 3600.0) return std::nullopt;
    return std::chrono::duration_cast<Instant>(Seconds(*seconds));
}

std::optional<unsigned> index_in(const std::string& text, unsigned last) {
    const auto number = number_in(text);
    if (!number || *number < 0.0 || *number > last || *number != std::floor(*number)) return std::nullopt;
    return static_cast<unsigned>(*number);
}

}  // namespace eddy::redir
