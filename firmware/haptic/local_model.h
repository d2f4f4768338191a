#pragma once
#include <glm/glm.hpp>

#include "hal/clock.h"

namespace eddy {

/// The motion of the body and the force on it that belong together: one answer of the fluid.
struct FluidAnswer {
    glm::dvec3 force_n{0.0};
    glm::dvec3 velocity_m_s{0.0};  ///< of the body over the step that gave the force
    glm::dvec3 acceleration_m_s2{0.0};
};

/// What slopes may be; none is ever below 0.
struct SlopeBounds {
    double drag_ns_m = 0.0;
    double added_kg = 0.0;
};

/// How the force of the fluid changes with the motion of the body, from the fluid's own answers of the last seconds:
///   force = what else there is - drag * velocity - added * acceleration
/// by least squares that forget, about the mean of the same seconds (a steady jet is no slope), over all three axes at once.
/// The prior is a slope of nothing give or take its bound: where the answers tell little, or scatter, the slopes stay near 0.
/// Between answers they are followed slowly, so that a better knowledge of them is no tap on the hand.
class LocalModel {
  public:
    /// Answers older than this count for less than 1/e.
    static constexpr Seconds kMemory{1.0};
    /// The slopes in use follow those found so fast.
    static constexpr Seconds kFollow{0.2};

    /// A new answer, `period` after the last.
    void learn(const FluidAnswer& answer, Seconds period, const SlopeBounds& bounds);
    /// A tick. Whatever was found: no slope is beyond these bounds, which another gain may have narrowed.
    void follow(Seconds dt, const SlopeBounds& bounds);
    /// Nothing is known any more.
    void forget() { *this = LocalModel{}; }

    double drag_ns_m() const { return drag_ns_m_; }
    double added_kg() const { return added_kg_; }
    /// The part of the force's changes that the slopes account for, 0 .. 1.
    double explained() const { return explained_; }
    /// What the slopes make of a motion.
    glm::dvec3 force_n(const glm::dvec3& velocity_m_s, const glm::dvec3& acceleration_m_s2) const {
        return -drag_ns_m_ * velocity_m_s - added_kg_ * acceleration_m_s2;
    }

  private:
    /// Sums over the answers, each less by the time that has passed since.
    struct Sums {
        double count = 0.0;
        glm::dvec3 force{0.0}, velocity{0.0}, acceleration{0.0};
        double ff = 0.0, vv = 0.0, aa = 0.0, va = 0.0, fv = 0.0, fa = 0.0;  ///< dot products
    };
    void solve(const SlopeBounds& bounds);

    Sums sums_;
    double found_drag_ns_m_ = 0.0, found_added_kg_ = 0.0;
    double drag_ns_m_ = 0.0, added_kg_ = 0.0;
    double explained_ = 0.0;
};

}  // namespace eddy
