#include "gles/fluid/contacts.h"

#include <algorithm>

#include "gles/body/rigid_body.h"

namespace eddy::gles {
namespace {

/// Cells that stay between a body and what stops it: enough for the pressure to pass between, and for no wall's face to be
/// cut.
constexpr double kGapCells = 1.0;
/// A contact resists as this many times the body's inertia would: all but rigid, and solvable however many there are.
constexpr double kStiffness = 1e3;

/// How far a body reaches from its middle in a direction.
double reach_m(const Shape& shape, const BodyState& state, const glm::dvec3& direction) {
    const glm::dvec3 x(1.0, 0.0, 0.0), from_centre = middle_m(shape, state) - state.centre_m;
    return extent(shape, glm::dquat(direction, x) * state.orientation).high.x -
           glm::dot(direction, from_centre);
}

glm::dvec3 velocity_of_middle(const Shape& shape, const BodyState& state) {
    return state.velocity_m_s + glm::cross(state.spin_rad_s, middle_m(shape, state) - state.centre_m);
}

/// What a solution holds for a body.
glm::dvec3 of_body(const std::vector<double>& x, const std::optional<std::size_t>& first) {
    return first ? glm::dvec3(x[*first], x[*first + 1], x[*first + 2]) : glm::dvec3(0.0);
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

/// What must be added to a row's right-hand side for x to solve it.
double residual(const LinearSystem& system, const std::vector<double>& x, std::size_t row) {
    double sum = -system.b(row);
    for (std::size_t l = 0; l < x.size(); ++l) sum += system.a(row, l) * x[l];
    return sum;
}

}  // namespace

Extent Contacts::room_m(std::size_t body, const glm::dquat& orientation) const {
    return room_for_centre(extent(setup_->bodies[body].shape, orientation),
                           setup_->cell_m * glm::dvec3(setup_->cells), kGapCells * setup_->cell_m);
}

void Contacts::separate(std::vector<BodyState>& states, const Unknowns& unknowns) const {
    for (const Contact& pair : between_bodies(states, unknowns)) {
        if (pair.gap_m >= 0.0) continue;
        const double share = unknowns[pair.a] && unknowns[*pair.b] ? 0.5 : 1.0;
        if (unknowns[pair.a]) states[pair.a].centre_m -= share * pair.gap_m * pair.normal;
        if (unknowns[*pair.b]) states[*pair.b].centre_m += share * pair.gap_m * pair.normal;
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!unknowns[i]) continue;
        const Extent room = room_m(i, states[i].orientation);
        states[i].centre_m = glm::clamp(states[i].centre_m, room.low, room.high);
    }
}

std::vector<Contacts::Contact> Contacts::between_bodies(const std::vector<BodyState>& states,
                                                        const Unknowns& unknowns) const {
    std::vector<Contact> result;
    for (std::size_t a = 0; a < states.size(); ++a)
        for (std::size_t b = 0; b < states.size(); ++b) {
            const BodySetup &one = setup_->bodies[a], &other = setup_->bodies[b];
            // Each two once; a container is always b.
            const bool in_container = other.inside_out && std::holds_alternative<Sphere>(other.shape);
            if (one.inside_out || (other.inside_out ? !in_container : a <= b)) continue;
            if (!unknowns[a] && !unknowns[b]) continue;
            const glm::dvec3 between = middle_m(one.shape, states[a]) - middle_m(other.shape, states[b]);
            const double distance = glm::length(between);
            // From one and the same place they part upwards and downwards: no way is better.
            const glm::dvec3 out = distance > 0.0 ? between / distance : glm::dvec3(0.0, 1.0, 0.0);
            const glm::dvec3 normal = in_container ? -out : out;
            const double reach = reach_m(one.shape, states[a], -normal);
            const double reach_of_b = reach_m(other.shape, states[b], out);
            const double room = in_container ? reach_of_b - distance : distance - reach_of_b;
            const glm::dvec3 apart =
                velocity_of_middle(one.shape, states[a]) - velocity_of_middle(other.shape, states[b]);
            result.push_back(
                {a, b, normal, room - reach - kGapCells * setup_->cell_m, glm::dot(normal, apart)});
        }
    return result;
}

std::vector<Contacts::Contact> Contacts::at_walls(const std::vector<BodyState>& states,
                                                  const Unknowns& unknowns, double dt_s) const {
    std::vector<Contact> result;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const BodyState& state = states[i];
        const Extent room = room_m(i, turned(state.orientation, state.spin_rad_s, dt_s));
        for (int axis = 0; unknowns[i] && axis < 3; ++axis) {
            glm::dvec3 n(0.0);
            n[axis] = 1.0;
            const double x = state.centre_m[axis], v = state.velocity_m_s[axis];
            result.push_back({i, std::nullopt, n, x - room.low[axis], v, axis});
            result.push_back({i, std::nullopt, -n, room.high[axis] - x, -v, axis});
        }
    }
    return result;
}

std::vector<double> Contacts::solve(const LinearSystem& system, const std::vector<BodyState>& states,
                                    const Unknowns& unknowns, double dt_s) {
    contacts_ = between_bodies(states, unknowns);
    for (Contact& pair : contacts_) pair.gap_m = std::max(pair.gap_m, 0.0);
    const std::vector<Contact> walls = at_walls(states, unknowns, dt_s);
    contacts_.insert(contacts_.end(), walls.begin(), walls.end());
    const auto of_b = [&](const Contact& c) { return c.b ? unknowns[*c.b] : std::nullopt; };
    // What is stopped may push others into what stops them, or away from it; so again, until all contacts push and
    // nothing gets through. One that has let go once and closes again stays, so that this ends.
    for (;;) {
        LinearSystem pushed = system;
        for (const Contact& c : contacts_)
            if (c.holds && c.b)
                hold(pushed, system, unknowns[c.a], of_b(c), c.normal, -c.gap_m / dt_s - c.opening_m_s);
        LinearSystem held = pushed;
        for (const Contact& c : contacts_)
            if (c.holds && !c.b)
                held.fix(row_of(c, unknowns), c.normal[c.axis] * (-c.gap_m / dt_s - c.opening_m_s));
        const std::vector<double> change = held.solve();
        const auto gap_after_m = [&](const Contact& c) {
            const glm::dvec3 more = of_body(change, unknowns[c.a]) - of_body(change, of_b(c));
            return c.gap_m + dt_s * (c.opening_m_s + glm::dot(c.normal, more));
        };
        const auto pulls = [&](const Contact& c) {
            if (c.b) return gap_after_m(c) > 0.0;
            return c.normal[c.axis] * residual(pushed, change, row_of(c, unknowns)) < 0.0;
        };
        bool again = false;
        for (Contact& c : contacts_)
            if (!c.holds && gap_after_m(c) < 0.0) c.holds = again = true;
        if (again) continue;
        for (Contact& c : contacts_)
            if (c.holds && !c.has_let_go && pulls(c)) {
                c.holds = false;
                c.has_let_go = again = true;
            }
        if (!again) return change;
    }
}

glm::dvec3 Contacts::along(std::size_t body, glm::dvec3 change) const {
    std::vector<glm::dvec3> taken;  // directions, square to each other
    for (const Contact& c : contacts_) {
        if (!c.holds || (c.a != body && c.b != body)) continue;
        glm::dvec3 n = c.normal;
        for (const glm::dvec3& other : taken) n -= glm::dot(n, other) * other;
        if (glm::length(n) < 1e-6) continue;
        taken.push_back(glm::normalize(n));
        change -= glm::dot(change, taken.back()) * taken.back();
    }
    return change;
}

}  // namespace eddy::gles
