#include "hal/gpio/find_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace eddy {
namespace {

constexpr std::size_t kNamesListed = 4;

struct ChipAndOffset {
    std::string chip;
    unsigned offset = 0;
};

/// A name may have a colon in it, too; what follows the last is a number in CHIP:OFFSET only.
std::optional<ChipAndOffset> chip_and_offset(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    if (colon == std::string::npos || colon == 0) return std::nullopt;
    ChipAndOffset parts{address.substr(0, colon), 0};
    const char* end = address.data() + address.size();
    const auto [rest, error] = std::from_chars(address.data() + colon + 1, end, parts.offset);
    if (error != std::errc{} || rest != end) return std::nullopt;
    return parts;
}

/// The path of a chip may be a link that a udev rule made.
bool is_called(const GpioChip& chip, const std::string& word) {
    if (word == chip.path || word == chip.name || word == chip.label) return true;
    std::error_code error;
    return word.starts_with('/') && std::filesystem::equivalent(word, chip.path, error);
}

/// Letters to put in, leave out or change to make `b` of `a`.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

/// ", nearest 'GPIO17', 'GPIO27'".
std::string nearest(const std::string& word, std::vector<std::string> words) {
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    std::stable_sort(words.begin(), words.end(), [&](const std::string& a, const std::string& b) {
        return distance(word, a) < distance(word, b);
    });
    if (words.size() > kNamesListed) words.resize(kNamesListed);
    std::string list;
    for (const std::string& each : words) list += fmt::format("{} '{}'", list.empty() ? "" : ",", each);
    return list;
}

/// What was not looked into may have it.
std::string unseen(const std::vector<GpioChip>& chips) {
    std::string text;
    for (const GpioChip& chip : chips)
        if (!chip.trouble.empty()) text += fmt::format("; {}: {}", chip.path, chip.trouble);
    return text;
}

GpioPlace at(const GpioChip& chip, std::size_t offset) {
    return {chip.path, static_cast<unsigned>(offset), chip.lines[offset]};
}

GpioPlace by_name(const std::vector<GpioChip>& chips, const std::string& name) {
    std::vector<GpioPlace> found;
    std::vector<std::string> names;
    std::string places;
    for (const GpioChip& chip : chips)
        for (std::size_t i = 0; i < chip.lines.size(); ++i) {
            if (!chip.lines[i].name.empty()) names.push_back(chip.lines[i].name);
            if (chip.lines[i].name != name) continue;
            found.push_back(at(chip, i));
            places += fmt::format("{} {}:{}", places.empty() ? "" : ",", chip.label, i);
        }
    if (found.size() == 1) return found.front();
    if (found.size() > 1)
        throw GpioError(fmt::format("there are {} GPIO lines called '{}': say which by CHIP:OFFSET,{}",
                                    found.size(), name, places));
    throw GpioError(fmt::format(
        "there is no GPIO line called '{}'{}{}; `eddy panel` lists all", name,
        names.empty() ? ": no line here has a name, write CHIP:OFFSET" : "; nearest:" + nearest(name, names),
        unseen(chips)));
}

GpioPlace by_offset(const std::vector<GpioChip>& chips, const ChipAndOffset& parts) {
    std::vector<const GpioChip*> found;
    std::vector<std::string> labels;
    std::string paths;
    for (const GpioChip& chip : chips) {
        if (!chip.label.empty()) labels.push_back(chip.label);
        if (!is_called(chip, parts.chip)) continue;
        found.push_back(&chip);
        paths += fmt::format("{} {}", paths.empty() ? "" : ",", chip.path);
    }
    if (found.empty())
        throw GpioError(fmt::format("there is no GPIO chip '{}'; there are{}{}", parts.chip,
                                    labels.empty() ? " none" : nearest(parts.chip, labels), unseen(chips)));
    if (found.size() > 1)
        throw GpioError(
            fmt::format("there are {} GPIO chips '{}': unplug one, or give the one a link of its own by a "
                        "udev rule and write "
                        "its path;{}",
                        found.size(), parts.chip, paths));
    const GpioChip& chip = *found.front();
    if (!chip.trouble.empty()) throw GpioError(fmt::format("{}: {}", chip.path, chip.trouble));
    if (parts.offset >= chip.lines.size())
        throw GpioError(fmt::format("GPIO chip '{}' has no line {}: it has {}, counted from 0", parts.chip,
                                    parts.offset, chip.lines.size()));
    return at(chip, parts.offset);
}

std::string refused(const std::string& address, const GpioPlace& place, const std::error_code& error) {
    const std::string where =
        fmt::format("GPIO line '{}' ({} line {})", address, place.chip_path, place.offset);
    switch (error.value()) {
        case EBUSY:
            if (place.info.consumer == "eddy")
                return fmt::format("{} is used by an eddy that runs already: systemctl stop eddy", where);
            if (place.info.consumer.empty())
                return fmt::format("{} is used by something that does not say its name: name another line",
                                   where);
            return fmt::format("{} is used by '{}': end that, or name another line", where,
                               place.info.consumer);
        case EACCES:
        case EPERM:
            return fmt::format("{} may not be requested by this user", where);
        case ENODEV:
        case ENXIO:
            return fmt::format("{} went away: is its USB bridge plugged in?", where);
        default:
            return fmt::format("{} cannot be requested: {}", where, error.message());
    }
}

}  // namespace

GpioPlace find_line(const std::vector<GpioChip>& chips, const std::string& address) {
    if (chips.empty())
        throw GpioError(
            fmt::format("there is no GPIO chip in this machine (no /dev/gpiochip*), so no line '{}': plug in "
                        "a USB bridge, or "
                        "load the driver of the board's header",
                        address));
    const auto parts = chip_and_offset(address);
    return parts ? by_offset(chips, *parts) : by_name(chips, address);
}

std::unique_ptr<GpioLine> open_line(Gpio& gpio, const std::string& address, const GpioWish& wish) {
    const GpioPlace place = find_line(gpio.chips(), address);
    try {
        return gpio.request(place.chip_path, place.offset, wish);
    } catch (const std::system_error& e) {
        throw GpioError(refused(address, place, e.code()));
    }
}

}  // namespace eddy
