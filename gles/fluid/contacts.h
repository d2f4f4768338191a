#pragma once
#include <optional>
#include <vector>

#include "gles/fluid/setup.h"
#include "gles/linear_system.h"

namespace eddy::gles {

/// What keeps the bodies that the fluid moves inside the tank and out of the other bodies: they stop one cell before, as if
/// they were soft clay, and slide along. A wall holds the points of a body that are next to it, so that one that leans on it
/// comes to lie; towards another body, a body ends at the plane square to the line between their middles that touches
/// it, and is not turned. Of containers, only round ones stop what is in them. A contact pushes or lets go; it never pulls.
class Contacts {
  public:
    /// Which unknowns a body's velocity [m/s] and spin [m/s per cell] are, three each from these numbers on; none of what is
    /// not solved for.
    struct Unknowns {
        std::optional<std::size_t> velocity, spin;
    };

    explicit Contacts(const FluidSetup& setup) : setup_(&setup) {}

    /// Moves bodies that are where they must not be, or as far as there is room: out of the other body the shortest way, each
    /// of two free ones half of it, and into the tank.
    void separate(std::vector<BodyState>& states, const std::vector<Unknowns>& unknowns) const;
    /// Solves for the changes that velocities make from those of `states`, such that in another step like this one no body
    /// gets where it must not be.
    std::vector<double> solve(const LinearSystem& system, const std::vector<BodyState>& states,
                              const std::vector<Unknowns>& unknowns, double dt_s);
    /// What is left of a change of the three unknowns from `first` on without the directions in which that held them.
    glm::dvec3 along(std::size_t first, glm::dvec3 change) const;

  private:
    struct Pair {
        std::size_t a, b;
        glm::dvec3 normal;  // from b to a
        double gap_m;       // that may still close; negative: too close already
    };
    /// How fast a contact opens when three unknowns from one on grow by 1.
    struct Lever {
        std::size_t first;
        glm::dvec3 factor;
    };
    struct Contact {
        double gap_m;
        double opening_m_s;         // without the changes
        std::vector<Lever> levers;  // for the changes
        double give;  // how much faster it closes when it is pushed by 1 [m/s over newton seconds]
        bool holds = false;
        bool has_let_go = false;
    };

    std::vector<Pair> pairs(const std::vector<BodyState>& states,
                            const std::vector<Unknowns>& unknowns) const;
    void add_pairs(const LinearSystem& system, const std::vector<BodyState>& states,
                   const std::vector<Unknowns>& unknowns);
    void add_walls(const LinearSystem& system, const std::vector<BodyState>& states,
                   const std::vector<Unknowns>& unknowns);

    /// The impulses of contacts as unknowns more, [N s]; their rows say that what holds does not close.
    static LinearSystem with_impulses(const LinearSystem& system, const std::vector<Contact*>& held,
                                      double dt_s);

    const FluidSetup* setup_;
    std::vector<Contact> contacts_;  // of the last solve()
};

}  // namespace eddy::gles
