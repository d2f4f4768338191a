#include "gles/fluid/contacts.h"

#include <algorithm>
#include <limits>

#include "gles/body/bounds.h"

namespace eddy::gles {
namespace {

/// Cells that stay between a body and what stops it: enough for the pressure to pass between, and for no wall's face to be
/// cut.
constexpr double kGapCells = 1.0;
/// A contact resists as this many times the body's inertia would: all but rigid, and solvable however many there are.
/// Walls are never in each other's way.
constexpr double kStiffness = 1e3, kWallStiffness = 1e9;
/// A body that leans on a wall is held where it would touch if it were turned by this either way [rad].
constexpr double kTilt = 0.02;

/// The tank's axes.
const glm::dmat3 kAxes(1.0);

/// How far a body reaches from its middle in a direction.
double reach_from_middle_m(const Shape& shape, const BodyState& state, const glm::dvec3& direction) {
    const glm::dvec3 x(1.0, 0.0, 0.0), from_centre = middle_m(shape, state) - state.centre_m;
    return extent(shape, glm::dquat(direction, x) * state.orientation).high.x -
           glm::dot(direction, from_centre);
}

glm::dvec3 velocity_of_middle(const Shape& shape, const BodyState& state) {
    return state.velocity_m_s + glm::cross(state.spin_rad_s, middle_m(shape, state) - state.centre_m);
}

/// How far it reaches from its centre towards a wall, `way` 1 or -1 along an axis [m].
double reach_to_wall_m(const Extent& body, int axis, double way) {
    return way > 0.0 ? body.high[axis] : -body.low[axis];
}

/// The point of its surface that does. How much farther it reaches d, per angle by which it turns about w, is how far
/// along d x w the point is, for turning moves it by w x r.
glm::dvec3 farthest_m(const Shape& shape, const glm::dquat& orientation, int axis, double way) {
    constexpr double kSmall = 1e-5;  // [rad]
    const glm::dvec3 d = way * kAxes[axis];
    const auto reach = [&](const glm::dquat& turned) {
        return reach_to_wall_m(extent(shape, turned), axis, way);
    };
    glm::dvec3 r = reach(orientation) * d;
    for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
        const glm::dvec3 w = kAxes[other];
        const double gained =
            reach(glm::angleAxis(kSmall, w) * orientation) - reach(glm::angleAxis(-kSmall, w) * orientation);
        r += gained / (2.0 * kSmall) * glm::cross(d, w);
    }
    return r;
}

/// The points by which a wall on that side can hold it: one of a ball, else one for each way to lean.
std::vector<glm::dvec3> feet_m(const Shape& shape, const glm::dquat& orientation, int axis, double way) {
    const glm::dvec3 d = way * kAxes[axis];
    if (const Sphere* ball = std::get_if<Sphere>(&shape)) return {ball->radius_m * d};
    std::vector<glm::dvec3> feet;
    double farthest = -std::numeric_limits<double>::infinity();
    for (const int about : {(axis + 1) % 3, (axis + 2) % 3})
        for (const double angle : {kTilt, -kTilt}) {
            const glm::dquat lean = glm::angleAxis(angle, kAxes[about]);
            feet.push_back(glm::conjugate(lean) * farthest_m(shape, lean * orientation, axis, way));
            farthest = std::max(farthest, glm::dot(d, feet.back()));
        }
    // On a round surface all of them are a little short of where it touches now.
    const double lacking = reach_to_wall_m(extent(shape, orientation), axis, way) - farthest;
    for (glm::dvec3& foot : feet) foot += lacking * d;
    return feet;
}

/// The middle of the side that its extent turns to a wall: enough where the wall is so far off that turning alone cannot
/// bring the body to it.
glm::dvec3 far_foot_m(const Extent& body, int axis, double way) {
    glm::dvec3 foot = 0.5 * (body.low + body.high);
    foot[axis] = way * reach_to_wall_m(body, axis, way);
    return foot;
}

glm::dvec3 three(const std::vector<double>& x, std::size_t first) {
    return {x[first], x[first + 1], x[first + 2]};
}

double largest_inertia(const LinearSystem& system, std::size_t first) {
    return std::max({system.a(first, first), system.a(first + 1, first + 1), system.a(first + 2, first + 2)});
}

}  // namespace

std::vector<Contacts::Pair> Contacts::pairs(const std::vector<BodyState>& states,
                                            const std::vector<Unknowns>& unknowns) const {
    std::vector<Pair> result;
    for (std::size_t a = 0; a < states.size(); ++a)
        for (std::size_t b = 0; b < states.size(); ++b) {
            const BodySetup &one = setup_->bodies[a], &other = setup_->bodies[b];
            // Each two once; a container is always b.
            const bool in_container = other.inside_out && std::holds_alternative<Sphere>(other.shape);
            if (one.inside_out || (other.inside_out ? !in_container : a <= b)) continue;
            if (!unknowns[a].velocity && !unknowns[b].velocity) continue;
            const glm::dvec3 between = middle_m(one.shape, states[a]) - middle_m(other.shape, states[b]);
            const double distance = glm::length(between);
            // From one and the same place they part upwards and downwards: no way is better.
            const glm::dvec3 out = distance > 0.0 ? between / distance : kAxes[1];
            const glm::dvec3 normal = in_container ? -out : out;
            const double reach = reach_from_middle_m(one.shape, states[a], -normal);
            const double reach_of_b = reach_from_middle_m(other.shape, states[b], out);
            const double room = in_container ? reach_of_b - distance : distance - reach_of_b;
            result.push_back({a, b, normal, room - reach - kGapCells * setup_->cell_m});
        }
    return result;
}

void Contacts::separate(std::vector<BodyState>& states, const std::vector<Unknowns>& unknowns) const {
    for (const Pair& pair : pairs(states, unknowns)) {
        if (pair.gap_m >= 0.0) continue;
        const bool a = unknowns[pair.a].velocity.has_value(), b = unknowns[pair.b].velocity.has_value();
        const double share = a && b ? 0.5 : 1.0;
        if (a) states[pair.a].centre_m -= share * pair.gap_m * pair.normal;
        if (b) states[pair.b].centre_m += share * pair.gap_m * pair.normal;
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!unknowns[i].velocity) continue;
        const Extent room =
            room_for_centre(extent(setup_->bodies[i].shape, states[i].orientation),
                            setup_->cell_m * glm::dvec3(setup_->cells), kGapCells * setup_->cell_m);
        states[i].centre_m = glm::clamp(states[i].centre_m, room.low, room.high);
    }
}

void Contacts::add_pairs(const LinearSystem& system, const std::vector<BodyState>& states,
                         const std::vector<Unknowns>& unknowns) {
    for (const Pair& pair : pairs(states, unknowns)) {
        const glm::dvec3 apart = velocity_of_middle(setup_->bodies[pair.a].shape, states[pair.a]) -
                                 velocity_of_middle(setup_->bodies[pair.b].shape, states[pair.b]);
        Contact contact{std::max(pair.gap_m, 0.0), glm::dot(pair.normal, apart), {}, 0.0};
        double inertia = 0.0;
        for (const auto& [body, sign] : {std::pair{pair.a, 1.0}, std::pair{pair.b, -1.0}})
            if (const auto first = unknowns[body].velocity) {
                contact.levers.push_back({*first, sign * pair.normal});
                inertia = std::max(inertia, largest_inertia(system, *first));
            }
        contact.give = 1.0 / (kStiffness * inertia);
        contacts_.push_back(contact);
    }
}

void Contacts::add_walls(const LinearSystem& system, const std::vector<BodyState>& states,
                         const std::vector<Unknowns>& unknowns) {
    const double h = setup_->cell_m, gap_m = kGapCells * h;
    const glm::dvec3 size = h * glm::dvec3(setup_->cells);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!unknowns[i].velocity) continue;
        const BodyState& state = states[i];
        const Shape& shape = setup_->bodies[i].shape;
        const Extent all = extent(shape, state.orientation);
        const glm::dvec3 lacking = glm::max(all.high - all.low + 2.0 * gap_m - size, 0.0);
        const double give = 1.0 / (kWallStiffness * largest_inertia(system, *unknowns[i].velocity));
        const double turning_reach_m = bounding_ball(shape).radius_m;
        for (int axis = 0; axis < 3; ++axis)
            for (const double way : {-1.0, 1.0}) {
                const double middle = state.centre_m[axis];
                const double room = (way > 0.0 ? size[axis] - middle : middle) - gap_m + 0.5 * lacking[axis];
                const bool far = room - reach_to_wall_m(all, axis, way) > turning_reach_m;
                const std::vector<glm::dvec3> feet = far ? std::vector{far_foot_m(all, axis, way)}
                                                         : feet_m(shape, state.orientation, axis, way);
                for (const glm::dvec3& foot : feet) {
                    const glm::dvec3 n = -way * kAxes[axis];
                    const double gap = room - way * foot[axis];
                    const double opening =
                        glm::dot(n, state.velocity_m_s + glm::cross(state.spin_rad_s, foot));
                    Contact contact{gap, opening, {{*unknowns[i].velocity, n}}, give};
                    if (unknowns[i].spin)
                        contact.levers.push_back({*unknowns[i].spin, glm::cross(foot, n) / h});
                    contacts_.push_back(contact);
                }
            }
    }
}

LinearSystem Contacts::with_impulses(const LinearSystem& system, const std::vector<Contact*>& held,
                                     double dt_s) {
    const std::size_t n = system.unknowns();
    LinearSystem all(n + held.size());
    for (std::size_t k = 0; k < n; ++k) {
        all.b(k) = system.b(k);
        for (std::size_t l = 0; l < n; ++l) all.a(k, l) = system.a(k, l);
    }
    for (std::size_t j = 0; j < held.size(); ++j) {
        const Contact& c = *held[j];
        all.b(n + j) = -c.gap_m / dt_s - c.opening_m_s;
        all.a(n + j, n + j) = c.give;
        for (const Lever& lever : c.levers)
            for (int i = 0; i < 3; ++i) {
                const std::size_t k = lever.first + static_cast<std::size_t>(i);
                all.a(n + j, k) = lever.factor[i];
                all.a(k, n + j) = -lever.factor[i];
            }
    }
    return all;
}

std::vector<double> Contacts::solve(const LinearSystem& system, const std::vector<BodyState>& states,
                                    const std::vector<Unknowns>& unknowns, double dt_s) {
    contacts_.clear();
    add_pairs(system, states, unknowns);
    add_walls(system, states, unknowns);
    const std::size_t n = system.unknowns();
    const double nothing_m = 1e-9 * setup_->cell_m;
    // What is stopped may push others into what stops them, or away from it; so again, until all contacts push and
    // nothing gets through. One that has let go once and closes again stays, so that this ends.
    for (;;) {
        std::vector<Contact*> held;
        for (Contact& c : contacts_)
            if (c.holds) held.push_back(&c);
        const std::vector<double> x = with_impulses(system, held, dt_s).solve();
        bool again = false;
        for (Contact& c : contacts_) {
            double opening = c.opening_m_s;
            for (const Lever& lever : c.levers) opening += glm::dot(lever.factor, three(x, lever.first));
            if (!c.holds && c.gap_m + dt_s * opening < -nothing_m) c.holds = again = true;
        }
        if (again) continue;
        for (std::size_t j = 0; j < held.size(); ++j)
            if (x[n + j] < 0.0 && !held[j]->has_let_go) {
                held[j]->holds = false;
                held[j]->has_let_go = again = true;
            }
        if (!again) return {x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n)};
    }
}

glm::dvec3 Contacts::along(std::size_t first, glm::dvec3 change) const {
    std::vector<glm::dvec3> taken;  // directions, square to each other
    for (const Contact& c : contacts_)
        for (const Lever& lever : c.levers) {
            if (!c.holds || lever.first != first) continue;
            glm::dvec3 n = lever.factor;
            for (const glm::dvec3& other : taken) n -= glm::dot(n, other) * other;
            if (glm::length(n) <= 1e-6 * glm::length(lever.factor)) continue;
            taken.push_back(glm::normalize(n));
            change -= glm::dot(change, taken.back()) * taken.back();
        }
    return change;
}

}  // namespace eddy::gles
