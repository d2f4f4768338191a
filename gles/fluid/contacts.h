#pragma once
#include <optional>
#include <vector>

#include "gles/fluid/setup.h"
#include "gles/linear_system.h"

namespace eddy::gles {

/// What keeps the bodies that the fluid moves inside the tank and out of the other bodies: they stop one cell before, as if
/// they were soft clay, and slide along. At a wall a body ends at the ball around its centre that holds it; towards another
/// body, at the plane square to the line between their centres that touches it. Of containers, only round ones stop what
/// is in them.
class Contacts {
  public:
    explicit Contacts(const FluidSetup& setup);

    /// Moves bodies that are where they must not be, or as far as there is room: out of the other body the shortest way, each
    /// of two free ones half of it, and into the tank.
    void separate(std::vector<BodyState>& states,
                  const std::vector<std::optional<std::size_t>>& unknowns) const;
    /// Solves for the changes that velocities make from those of `states`, such that in another step like this one no body
    /// gets where it must not be. `unknowns`: for each body, the number of its velocity's first component, if it is
    /// solved for.
    std::vector<double> solve(const LinearSystem& system, const std::vector<BodyState>& states,
                              const std::vector<std::optional<std::size_t>>& unknowns, double dt_s);
    /// Whether that made velocity component k another than the fluid alone would have.
    bool stopped(std::size_t k) const { return stopped_[k]; }

  private:
    struct Pair {
        std::size_t a, b;
        glm::dvec3 normal;  // from b to a
        double gap_m;       // that may still close; negative: too close already
        bool touches = false;
    };
    std::vector<Pair> pairs(const std::vector<BodyState>& states,
                            const std::vector<std::optional<std::size_t>>& unknowns) const;

    glm::dvec3 inside(std::size_t body, const glm::dvec3& centre_m) const {
        return glm::clamp(centre_m, low_m_[body], high_m_[body]);
    }

    const FluidSetup* setup_;
    std::vector<glm::dvec3> low_m_, high_m_;  // where each body's centre may be
    std::vector<bool> stopped_;
};

}  // namespace eddy::gles
