#include "firmware/exhibit/lamp_table.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "firmware/exhibit/lamps.h"

namespace eddy {
namespace {

constexpr char kDark = '.';

struct Run {
    char letter;
    std::size_t steps;
};

std::vector<Run> runs_of(std::string_view pattern) {
    std::vector<Run> runs;
    for (const char letter : pattern) {
        if (runs.empty() || runs.back().letter != letter) runs.push_back({letter, 0});
        ++runs.back().steps;
    }
    return runs;
}

double seconds(std::size_t steps) {
    return static_cast<double>(steps) * Seconds(kLampStep).count();
}

std::string_view name_of(char letter, std::string_view all) {
    switch (letter) {
        case kDark:
            return "dark";
        case 'G':
            return "green";
        case 'A':
            return "amber";
        case 'R':
            return "red";
        case 'Y':
            return "yellow";
        case 'B':
            return "blue";
        case 'C':
            return "cyan";
        case 'W':
            return "white";
        default:
            return all;
    }
}

/// A pattern in words. `all`: what a star is here.
std::string words(std::string_view pattern, std::string_view all) {
    const std::vector<Run> runs = runs_of(pattern);
    if (runs.size() == 1) return std::string(name_of(runs.front().letter, all));
    if (runs.size() > 2)
        return fmt::format(
            "{}{} blinks every {:g} s", runs.size() / 2,
            runs.front().letter == '*' ? "" : fmt::format(" {}", name_of(runs.front().letter, all)),
            seconds(pattern.size()));
    std::string text;
    for (const Run& run : runs)
        text += fmt::format("{}{} {:g} s", text.empty() ? "" : ", ", name_of(run.letter, all),
                            seconds(run.steps));
    return text;
}

}  // namespace

std::string lamp_table() {
    std::string table =
        "| code | meaning | green, amber, red lamp | one lamp alone | ring of the Falcon "
        "|\n|---|---|---|---|---|\n";
    for (const LampRow& row : kLampRows)
        table += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.word, row.meaning,
                             words(row.three, "all three"), words(row.one, "lit"), words(row.ring, ""));
    return table;
}

}  // namespace eddy
