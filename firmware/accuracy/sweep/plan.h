#pragma once
#include <optional>
#include <string>
#include <vector>

#include "firmware/accuracy/sweep/setting.h"

namespace eddy::accuracy::sweep {

/// One case at one setting: what is measured, and what may be measured by another machine than the next.
struct Point {
    std::string problem;
    Setting setting;
    bool operator==(const Point&) const = default;
};

/// What the user asked for. Two sweeps of the same order have the same points.
struct Order {
    bool full = false;
    std::vector<std::string> cases = {};  ///< none: all
    std::vector<int> grids = {};          ///< none: each case's own
    bool operator==(const Order&) const = default;
};

/// Every point, cheap before dear within a case. Throws InputError for cases and grids that do not exist.
std::vector<Point> points_of(const Order& order);

/// Whether a point is measured stage by stage too: the usual setting of each method.
bool has_stages(const Point& point);

/// Every `of`-th point from the `number`-th on, so that each shard gets its part of the dear ones.
struct Shard {
    int number = 1;  ///< from 1
    int of = 1;
    bool holds(std::size_t index) const {
        return index % static_cast<std::size_t>(of) == static_cast<std::size_t>(number - 1);
    }
};

/// Reads "3/8". Throws InputError that says what is wrong with it.
Shard parse_shard(const std::string& text);

}  // namespace eddy::accuracy::sweep
