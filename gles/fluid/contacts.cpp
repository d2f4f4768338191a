#include "gles/fluid/contacts.h"

#include <algorithm>

#include "gles/body/bounds.h"

namespace eddy::gles {
namespace {

/// Cells that stay between a body and what stops it: enough for the pressure to pass between, and for no wall's face to be
/// cut.
constexpr double kGapCells = 1.0;
/// A contact resists as this many times the body's inertia would: all but rigid, and solvable however many there are.
constexpr double kStiffness = 1e3;

/// How far a body reaches from its centre in a direction.
double reach_m(const Shape& shape, const glm::dquat& orientation, const glm::dvec3& direction) {
    const glm::dvec3 x(1.0, 0.0, 0.0);
    return extent(shape, glm::dquat(direction, x) * orientation).high.x;
}

/// The velocities that a system solves for in place of those of a state.
glm::dvec3 velocity(const BodyState& state, const std::optional<std::size_t>& first,
                    const std::vector<double>& change) {
    if (!first) return state.velocity_m_s;
    return state.velocity_m_s + glm::dvec3(change[*first], change[*first + 1], change[*first + 2]);
}

/// Adds  c n (n . (V_a - V_b) - speed) = 0  to the rows of a and b. c follows from the `free` system: from one that
/// others hold already it would grow a thousandfold with every contact.
void hold(LinearSystem& system, const LinearSystem& free, const std::optional<std::size_t>& a,
          const std::optional<std::size_t>& b, const glm::dvec3& normal, double speed) {
    double c = 0.0;
    for (const auto& first : {a, b})
        for (std::size_t i = 0; first && i < 3; ++i)
            c = std::max(c, kStiffness * free.a(*first + i, *first + i));
    for (const auto& [row, sign] : {std::pair{a, 1.0}, std::pair{b, -1.0}})
        for (int i = 0; row && i < 3; ++i) {
            const std::size_t k = *row + static_cast<std::size_t>(i);
            system.b(k) += c * sign * normal[i] * speed;
            for (const auto& [column, other] : {std::pair{a, 1.0}, std::pair{b, -1.0}})
                for (int j = 0; column && j < 3; ++j)
                    system.a(k, *column + static_cast<std::size_t>(j)) +=
                        c * sign * other * normal[i] * normal[j];
        }
}

}  // namespace

Contacts::Contacts(const FluidSetup& setup) : setup_(&setup) {
    const glm::dvec3 size = setup.cell_m * glm::dvec3(setup.cells);
    for (const BodySetup& body : setup.bodies) {
        const double margin = bounding_radius_m(body.shape) + kGapCells * setup.cell_m;
        low_m_.push_back(glm::min(glm::dvec3(margin), 0.5 * size));
        high_m_.push_back(size - low_m_.back());
    }
}

void Contacts::separate(std::vector<BodyState>& states,
                        const std::vector<std::optional<std::size_t>>& unknowns) const {
    for (const Pair& pair : pairs(states, unknowns)) {
        if (pair.gap_m >= 0.0) continue;
        const double share = unknowns[pair.a] && unknowns[pair.b] ? 0.5 : 1.0;
        if (unknowns[pair.a]) states[pair.a].centre_m -= share * pair.gap_m * pair.normal;
        if (unknowns[pair.b]) states[pair.b].centre_m += share * pair.gap_m * pair.normal;
    }
    for (std::size_t i = 0; i < states.size(); ++i)
        if (unknowns[i]) states[i].centre_m = inside(i, states[i].centre_m);
}

std::vector<Contacts::Pair> Contacts::pairs(const std::vector<BodyState>& states,
                                            const std::vector<std::optional<std::size_t>>& unknowns) const {
    std::vector<Pair> result;
    for (std::size_t a = 0; a < states.size(); ++a)
        for (std::size_t b = 0; b < states.size(); ++b) {
            const BodySetup &one = setup_->bodies[a], &other = setup_->bodies[b];
            // Each two once; a container is always b.
            const bool in_container = other.inside_out && std::holds_alternative<Sphere>(other.shape);
            if (one.inside_out || (other.inside_out ? !in_container : a <= b)) continue;
            const glm::dvec3 between = states[a].centre_m - states[b].centre_m;
            const double distance = glm::length(between);
            if ((!unknowns[a] && !unknowns[b]) || distance == 0.0) continue;
            const glm::dvec3 out = between / distance;
            const glm::dvec3 normal = in_container ? -out : out;
            const double reach = reach_m(one.shape, states[a].orientation, -normal);
            const double reach_of_b = reach_m(other.shape, states[b].orientation, out);
            const double room = in_container ? reach_of_b - distance : distance - reach_of_b;
            result.push_back({a, b, normal, room - reach - kGapCells * setup_->cell_m});
        }
    return result;
}

std::vector<double> Contacts::solve(const LinearSystem& system, const std::vector<BodyState>& states,
                                    const std::vector<std::optional<std::size_t>>& unknowns, double dt_s) {
    stopped_.assign(system.unknowns(), false);
    std::vector<Pair> near = pairs(states, unknowns);
    std::vector<std::optional<double>> fixed(system.unknowns());
    // What is stopped may push others into what stops them; so again, until nothing new is.
    for (;;) {
        LinearSystem held = system;
        for (const Pair& pair : near)
            if (pair.touches)
                hold(held, system, unknowns[pair.a], unknowns[pair.b], pair.normal,
                     -std::max(pair.gap_m, 0.0) / dt_s -
                         glm::dot(pair.normal, states[pair.a].velocity_m_s - states[pair.b].velocity_m_s));
        for (std::size_t k = 0; k < fixed.size(); ++k)
            if (fixed[k]) held.fix(k, *fixed[k]);
        const std::vector<double> change = held.solve();
        bool again = false;
        for (Pair& pair : near) {
            const glm::dvec3 apart = velocity(states[pair.a], unknowns[pair.a], change) -
                                     velocity(states[pair.b], unknowns[pair.b], change);
            if (pair.touches || std::max(pair.gap_m, 0.0) + dt_s * glm::dot(pair.normal, apart) >= 0.0)
                continue;
            pair.touches = again = true;
            for (const auto& first : {unknowns[pair.a], unknowns[pair.b]})
                for (std::size_t i = 0; first && i < 3; ++i) stopped_[*first + i] = true;
        }
        for (std::size_t body = 0; body < states.size(); ++body) {
            const glm::dvec3 here = states[body].centre_m;
            const glm::dvec3 next = here + dt_s * velocity(states[body], unknowns[body], change);
            const glm::dvec3 allowed = inside(body, next);
            for (int i = 0; unknowns[body] && i < 3; ++i) {
                const std::size_t k = *unknowns[body] + static_cast<std::size_t>(i);
                if (fixed[k] || next[i] == allowed[i]) continue;
                fixed[k] = (allowed[i] - here[i]) / dt_s - states[body].velocity_m_s[i];
                stopped_[k] = again = true;
            }
        }
        if (!again) return change;
    }
}

}  // namespace eddy::gles
