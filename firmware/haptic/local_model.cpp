#include "firmware/haptic/local_model.h"

#include <algorithm>
#include <cmath>

#include "firmware/haptic/exponential.h"
#include "firmware/haptic/vector.h"

namespace eddy {
namespace {

/// Fewer answers than this are no evidence.
constexpr double kFewest = 4.0;
/// Forces are not taken for more exact than this share of their scatter, or a slope found from a movement too small to feel would
/// count as known.
constexpr double kForceNoise = 0.01;

/// Least squares of y = -drag v - added a with a ridge on each. All are sums of products about the mean.
struct Fit {
    double vv, va, aa, yv, ya, yy;

    struct Slopes {
        double drag, added;
    };
    Slopes both(double ridge_v, double ridge_a) const {
        const double v = vv + ridge_v, a = aa + ridge_a, det = v * a - va * va;
        if (!(det > 0.0)) return {0.0, 0.0};
        Slopes s{-(a * yv - va * ya) / det, -(v * ya - va * yv) / det};
        // A slope that would be below 0 is 0, and the other alone.
        if (s.drag < 0.0) s = {0.0, -ya / a};
        if (s.added < 0.0) s = {std::max(0.0, -yv / v), 0.0};
        return {std::max(0.0, s.drag), std::max(0.0, s.added)};
    }
    double left_over(const Slopes& s) const {
        return yy + 2.0 * (s.drag * yv + s.added * ya) + s.drag * s.drag * vv + 2.0 * s.drag * s.added * va +
               s.added * s.added * aa;
    }
};

}  // namespace

void LocalModel::learn(const FluidAnswer& answer, Seconds period, const SlopeBounds& bounds) {
    if (!is_finite(answer.force_n) || !is_finite(answer.velocity_m_s) || !is_finite(answer.acceleration_m_s2))
        return;
    const double kept = left_of(std::max(0.0, period.count()) / kMemory.count());
    Sums& s = sums_;
    const glm::dvec3 &f = answer.force_n, &v = answer.velocity_m_s, &a = answer.acceleration_m_s2;
    s.count = kept * s.count + 1.0;
    s.force = kept * s.force + f;
    s.velocity = kept * s.velocity + v;
    s.acceleration = kept * s.acceleration + a;
    s.ff = kept * s.ff + glm::dot(f, f);
    s.vv = kept * s.vv + glm::dot(v, v);
    s.aa = kept * s.aa + glm::dot(a, a);
    s.va = kept * s.va + glm::dot(v, a);
    s.fv = kept * s.fv + glm::dot(f, v);
    s.fa = kept * s.fa + glm::dot(f, a);
    solve(bounds);
}

void LocalModel::solve(const SlopeBounds& bounds) {
    found_drag_ns_m_ = found_added_kg_ = explained_ = 0.0;
    const Sums& s = sums_;
    if (s.count < kFewest || !(bounds.drag_ns_m > 0.0) || !(bounds.added_kg > 0.0)) return;
    const auto about_mean = [&s](double sum, const glm::dvec3& a, const glm::dvec3& b) {
        return sum - glm::dot(a, b) / s.count;
    };
    const Fit fit{.vv = about_mean(s.vv, s.velocity, s.velocity),
                  .va = about_mean(s.va, s.velocity, s.acceleration),
                  .aa = about_mean(s.aa, s.acceleration, s.acceleration),
                  .yv = about_mean(s.fv, s.force, s.velocity),
                  .ya = about_mean(s.fa, s.force, s.acceleration),
                  .yy = about_mean(s.ff, s.force, s.force)};
    if (!(fit.yy > 0.0) || !std::isfinite(fit.yy)) return;
    // How much forces scatter about the best slopes says how far these may be believed.
    const double tiny = 1e-12;
    const Fit::Slopes best = fit.both(tiny * fit.vv, tiny * fit.aa);
    const double freedoms = 3.0 * s.count - 5.0;  // three means and two slopes are taken from the answers
    const double scatter = std::max(fit.left_over(best), kForceNoise * kForceNoise * fit.yy) / freedoms;
    const Fit::Slopes sure = fit.both(scatter / (bounds.drag_ns_m * bounds.drag_ns_m),
                                      scatter / (bounds.added_kg * bounds.added_kg));
    found_drag_ns_m_ = std::min(sure.drag, bounds.drag_ns_m);
    found_added_kg_ = std::min(sure.added, bounds.added_kg);
    explained_ = std::clamp(1.0 - fit.left_over({found_drag_ns_m_, found_added_kg_}) / fit.yy, 0.0, 1.0);
}

void LocalModel::follow(Seconds dt, const SlopeBounds& bounds) {
    const double share = dt.count() > 0.0 ? gone_of(dt / kFollow) : 0.0;
    drag_ns_m_ = std::min(drag_ns_m_ + share * (found_drag_ns_m_ - drag_ns_m_), bounds.drag_ns_m);
    added_kg_ = std::min(added_kg_ + share * (found_added_kg_ - added_kg_), bounds.added_kg);
}

}  // namespace eddy
