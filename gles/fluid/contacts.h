#pragma once
#include <optional>
#include <vector>

#include "gles/body/bounds.h"
#include "gles/linear_system.h"

namespace eddy::gles {

/// What keeps the bodies that the fluid moves inside the tank and out of the other bodies: they stop one cell before, as if
/// they were soft clay, and slide along. At a wall a body ends where it does, as it will be turned at the end of the
/// next step; towards another body, at the plane square to the line between their middles that touches it. Of containers,
/// only round ones stop what is in them. A contact pushes, never pulls, and turns no body.
class Contacts {
  public:
    /// For each body, the number of its velocity's first component, if it is solved for.
    using Unknowns = std::vector<std::optional<std::size_t>>;

    explicit Contacts(const FluidSetup& setup) : setup_(&setup) {}

    /// Moves bodies that are where they must not be, or as far as there is room: out of the other body the shortest way, each
    /// of two free ones half of it, and into the tank.
    void separate(std::vector<BodyState>& states, const Unknowns& unknowns) const;
    /// Solves for the changes that velocities make from those of `states`, such that in another step like this one no body
    /// gets where it must not be.
    std::vector<double> solve(const LinearSystem& system, const std::vector<BodyState>& states,
                              const Unknowns& unknowns, double dt_s);
    /// What is left of a change of the body's velocity without the directions in which that held it.
    glm::dvec3 along(std::size_t body, glm::dvec3 change) const;

  private:
    struct Contact {
        std::size_t a;
        std::optional<std::size_t> b;  // the other body; none: a wall
        glm::dvec3 normal;             // towards a
        double gap_m;                  // that may still close; negative: too close already
        double opening_m_s;            // how fast it opens without the changes
        int axis = 0;                  // that the wall is square to
        bool holds = false;
        bool has_let_go = false;
    };

    std::vector<Contact> between_bodies(const std::vector<BodyState>& states, const Unknowns& unknowns) const;
    std::vector<Contact> at_walls(const std::vector<BodyState>& states, const Unknowns& unknowns,
                                  double dt_s) const;
    static std::size_t row_of(const Contact& wall, const Unknowns& unknowns) {
        return *unknowns[wall.a] + static_cast<std::size_t>(wall.axis);
    }
    /// Where the body's centre may be.
    Extent room_m(std::size_t body, const glm::dquat& orientation) const;

    const FluidSetup* setup_;
    std::vector<Contact> contacts_;  // of the last solve()
};

}  // namespace eddy::gles
