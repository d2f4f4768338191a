#include "firmware/accuracy/sweep/plan.h"

#include <fmt/format.h>

#include <charconv>

#include "firmware/accuracy/study.h"
#include "firmware/accuracy/sweep/problem.h"
#include "firmware/input_error.h"

namespace eddy::accuracy::sweep {
namespace {

/// How often each method iterates on the pressure, where that is what is looked at.
std::vector<int> iterations(SolverPreset method, bool full) {
    switch (method) {
        case SolverPreset::Fast:
            return full ? std::vector{1, 2, 3, 4, 6, 8} : std::vector{1, 2, 3, 4};
        case SolverPreset::Precise:
            return full ? std::vector{1, 2, 3, 4, 6, 8, 12} : std::vector{1, 2, 3, 4, 6};
        case SolverPreset::Yang2009:
            return full ? std::vector{5, 10, 20, 40, 80, 160, 320} : std::vector{10, 20, 40, 80, 160};
    }
    throw std::logic_error("a method without iterations");
}

/// Where it is not: what the preset has, less, and more.
std::vector<int> few_iterations(SolverPreset method, bool full) {
    if (full) return iterations(method, true);
    return method == SolverPreset::Yang2009 ? std::vector{20, 40}
                                            : std::vector{1, usual_iterations(method), 6};
}

class Points {
  public:
    Points(const Problem& problem, bool full) : problem_(problem), full_(full) {}

    void on_grid(int cells) {
        const std::string& name = problem_.name;
        for (const SolverPreset method : kMethods) {
            const bool yang = method == SolverPreset::Yang2009;
            const Setting usual{method, cells, usual_iterations(method)};
            // Its velocities do not lie on faces, where the case takes them.
            if (name == "A1" && yang) continue;
            if (name == "A1") {
                add(usual);
            } else if (name == "B3" && yang && !full_) {
                if (cells <= 32) add(usual);  // it is half off at any grid: no need to wait for the dear ones
            } else {
                for (const int n : name == "B2" ? iterations(method, full_) : few_iterations(method, full_))
                    add({method, cells, n});
            }
            if (yang) continue;
            // The push of a ball that sets off does not depend on the time step.
            if (name != "B2")
                for (const double factor : full_ ? std::vector{0.25, 0.5, 2.0, 4.0} : std::vector{0.5, 2.0}) {
                    Setting other = usual;
                    other.dt_factor = factor;
                    add(other);
                }
            if (name == "B2" && method == SolverPreset::Fast)
                for (const ForceWay way : {ForceWay::Box, ForceWay::Impulse}) {
                    Setting other = usual;
                    other.force = way;
                    add(other);
                }
        }
    }

    std::vector<Point> points;

  private:
    void add(const Setting& setting) { points.push_back({problem_.name, setting}); }

    const Problem& problem_;
    bool full_;
};

}  // namespace

std::vector<Point> points_of(const Order& order) {
    std::vector<std::string> names = order.cases;
    if (names.empty())
        for (const Problem& problem : all_problems()) names.push_back(problem.name);
    std::vector<Point> all;
    for (const std::string& name : names) {
        const Problem& problem = problem_named(name);
        Points points(problem, order.full);
        for (const int cells :
             order.grids.empty() ? (order.full ? problem.full : problem.quick) : order.grids) {
            // Complains of a grid that does not fit the tank.
            scene_on_grid(problem.of, cells, order.grids.empty() ? kAnyGrid : kGridOption);
            points.on_grid(cells);
        }
        all.insert(all.end(), points.points.begin(), points.points.end());
    }
    return all;
}

bool has_stages(const Point& point) {
    const Setting& s = point.setting;
    return point.problem == "B2" && s == Setting{s.method, s.cells, usual_iterations(s.method)};
}

Shard parse_shard(const std::string& text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    const bool slash = number.ec == std::errc{} && number.ptr != end && *number.ptr == '/';
    const auto of = slash ? std::from_chars(number.ptr + 1, end, shard.of) : number;
    if (!slash || of.ec != std::errc{} || of.ptr != end)
        throw InputError(
            fmt::format("--shard '{}': write which part of how many, as 3/8 for the third of eight", text));
    if (shard.of < 1 || shard.number < 1 || shard.number > shard.of)
        throw InputError(fmt::format("--shard {}: parts count from 1 to {}; there is no part {}", text,
                                     shard.of, shard.number));
    return shard;
}

}  // namespace eddy::accuracy::sweep
