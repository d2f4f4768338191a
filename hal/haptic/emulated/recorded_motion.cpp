#include "hal/haptic/emulated/recorded_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "hal/haptic/emulated/minimum_jerk.h"

namespace eddy::emulated {
namespace {

constexpr std::string_view kHeader = "t_s,x_m,y_m,z_m";
constexpr double kFarthest = 1.0;     // [m] from the origin; beyond, the file is in other units
constexpr std::size_t kStencil = 5;   // samples from which a velocity is taken
constexpr double kLongestFade = 1.0;  // [s]

using Row = std::array<double, 4>;

struct Place {
    std::string_view name;
    int line;

    [[noreturn]] void refuse(std::string_view problem) const {
        throw std::runtime_error(fmt::format("{}:{}: {}", name, line, problem));
    }
};

Row parse_row(std::string_view text, const Place& place) {
    Row row{};
    std::string_view rest = text;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const std::size_t comma = rest.find(',');
        if ((i + 1 == row.size()) != (comma == std::string_view::npos))
            place.refuse(fmt::format("'{}' does not have four columns; write {}", text, kHeader));
        const std::string_view word = rest.substr(0, comma);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), row[i]);
        if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(row[i]))
            place.refuse(fmt::format("'{}' is not a number; write it as 0.0125", word));
        if (comma != std::string_view::npos) rest.remove_prefix(comma + 1);
    }
    return row;
}

}  // namespace

RecordedMotion::RecordedMotion(std::string_view csv, std::string_view name, const AxisMap& axes, AtEnd at_end)
    : at_end_(at_end) {
    read(csv, name, axes);
    estimate_velocities();
}

void RecordedMotion::read(std::string_view csv, std::string_view name, const AxisMap& axes) {
    bool header_seen = false;
    double start = 0.0;
    Place place{name, 0};
    while (!csv.empty()) {
        const std::size_t newline = csv.find('\n');
        std::string_view line = csv.substr(0, newline);
        csv.remove_prefix(newline == std::string_view::npos ? csv.size() : newline + 1);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        ++place.line;
        if (line.empty() || line.front() == '#') continue;
        if (!header_seen) {
            if (line != kHeader) place.refuse(fmt::format("expected the column names; write {}", kHeader));
            header_seen = true;
            continue;
        }
        const Row row = parse_row(line, place);
        if (samples_.empty()) start = row[0];
        const double t = row[0] - start;
        if (!samples_.empty() && t <= samples_.back().t)
            place.refuse(fmt::format(
                "time {} s does not come after the line before; sort the samples, drop repeats", row[0]));
        const glm::dvec3 position = axes({row[1], row[2], row[3]});
        if (std::max({std::abs(row[1]), std::abs(row[2]), std::abs(row[3])}) > kFarthest)
            place.refuse(
                "the hand is more than 1 m from the middle; write positions in metres, about the middle");
        samples_.push_back({t, position, glm::dvec3(0.0)});
    }
    if (!header_seen)
        place.refuse(fmt::format("the file holds no motion; begin it with the line {}", kHeader));
    if (samples_.size() < 2) place.refuse("a motion needs at least two samples; record for longer");
}

void RecordedMotion::estimate_velocities() {
    // The slope, at each sample, of the polynomial through the five samples around it (the nearest five at
    // the ends).
    const std::size_t width = std::min(kStencil, samples_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const std::size_t first = std::min(i - std::min(i, width / 2), samples_.size() - width);
        const double t = samples_[i].t;
        glm::dvec3 velocity(0.0);
        for (std::size_t j = first; j < first + width; ++j) {
            // Lagrange: the slope at t_i of the polynomial that is 1 at t_j and 0 at the others.
            double slope = 0.0;
            double ratio = 1.0;
            for (std::size_t m = first; m < first + width; ++m) {
                if (m == j) continue;
                if (j == i)
                    slope += 1.0 / (t - samples_[m].t);
                else
                    ratio *= (m == i ? 1.0 : t - samples_[m].t) / (samples_[j].t - samples_[m].t);
            }
            velocity += (j == i ? slope : ratio) * samples_[j].position;
        }
        samples_[i].velocity = velocity;
    }
}

glm::dvec3 RecordedMotion::at(double t) const {
    if (t <= 0.0) return samples_.front().position;
    if (t >= samples_.back().t) return samples_.back().position;
    const auto next = std::upper_bound(samples_.begin(), samples_.end(), t,
                                       [](double time, const Sample& sample) { return time < sample.t; });
    const Sample& a = *(next - 1);
    const Sample& b = *next;
    const double h = b.t - a.t;
    const double s = (t - a.t) / h;
    const double r = 1.0 - s;
    // Cubic Hermite: positions and velocities of both ends.
    return r * r * (1.0 + 2.0 * s) * a.position + s * s * (1.0 + 2.0 * r) * b.position +
           h * s * r * (r * a.velocity - s * b.velocity);
}

glm::dvec3 RecordedMotion::position_m(Seconds t) const {
    const double end = samples_.back().t;
    const double fade = std::min(kLongestFade, end / 4.0);
    const double period = end - fade;
    if (at_end_ == AtEnd::Hold || t.count() < period) return at(t.count());
    const double in_loop = std::fmod(t.count(), period);
    if (in_loop >= fade) return at(in_loop);
    // The first pass ran up to `period`; what was recorded after that fades into the beginning.
    return glm::mix(at(period + in_loop), at(in_loop), minimum_jerk(in_loop / fade));
}

}  // namespace eddy::emulated
