#include "firmware/force_comparison.h"

#include <algorithm>
#include <cmath>

namespace eddy {
namespace {

double square(const glm::dvec3& v) {
    return glm::dot(v, v);
}

std::optional<double> ratio(double squares, double force_squares) {
    if (force_squares == 0.0) return std::nullopt;
    return std::sqrt(squares / force_squares);
}

}  // namespace

std::vector<std::string> ForceComparison::columns() {
    std::vector<std::string> columns;
    for (const std::string method : {"force_box", "force_impulse", "transport"})
        for (const char* axis : {"_x_n", "_y_n", "_z_n"}) columns.push_back(method + axis);
    return columns;
}

std::vector<double> ForceComparison::values(const gles::ForceMethods& m) {
    std::vector<double> values;
    for (const glm::dvec3& v : {m.box_n, m.impulse_n, m.transport_n})
        for (int axis = 0; axis < 3; ++axis) values.push_back(v[axis]);
    return values;
}

void ForceComparison::add(const std::vector<gles::Load>& loads,
                          const std::vector<gles::ForceMethods>& methods) {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const glm::dvec3 force = loads[i].force_n;
        const gles::ForceMethods& m = methods[i];
        sums_[i].force += square(force);
        sums_[i].spread +=
            std::max({square(force - m.box_n), square(force - m.impulse_n), square(m.box_n - m.impulse_n)});
        sums_[i].transport += square(m.transport_n);
    }
}

std::optional<double> ForceComparison::spread(std::size_t body) const {
    return ratio(sums_[body].spread, sums_[body].force);
}
std::optional<double> ForceComparison::transport(std::size_t body) const {
    return ratio(sums_[body].transport, sums_[body].force);
}

}  // namespace eddy
