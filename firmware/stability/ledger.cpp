#include "firmware/stability/ledger.h"

#include <cmath>
#include <numbers>

#include "firmware/stability/field_work.h"
#include "gles/body/bounds.h"
#include "gles/body/mass_properties.h"
#include "gles/fluid/transport.h"

namespace eddy::stability {
namespace {

/// Places across the tank where formulas are looked at, each way.
constexpr int kLooks = 5;

/// The largest length of a formula anywhere in the tank.
double largest(const Scene& scene, const FormulaVector& formula, double time_s) {
    double most = 0.0;
    for (int z = 0; z < kLooks; ++z)
        for (int y = 0; y < kLooks; ++y)
            for (int x = 0; x < kLooks; ++x) {
                const glm::dvec3 at = scene.tank.size_m * glm::dvec3(x, y, z) / (kLooks - 1.0);
                most = std::max(most, glm::length(formula.evaluate(at, time_s)));
            }
    return most;
}

double largest(const Scene& scene, const Formula& formula) {
    double most = 0.0;
    for (int z = 0; z < kLooks; ++z)
        for (int y = 0; y < kLooks; ++y)
            for (int x = 0; x < kLooks; ++x) {
                const glm::dvec3 at = scene.tank.size_m * glm::dvec3(x, y, z) / (kLooks - 1.0);
                most = std::max(most, std::abs(formula.evaluate(at.x, at.y, at.z, 0.0)));
            }
    return most;
}

double square(double x) {
    return x * x;
}
double cube(double x) {
    return x * x * x;
}

}  // namespace

Ledger::Ledger(const Scene& scene, const gles::FluidSetup& setup, double narrowing, Inflow inflow)
    : scene_(scene),
      setup_(setup),
      tank_(tank_of(setup)),
      running_(scene.sources.size(), false),
      inflow_seen_(inflow == Inflow::Seen && tank_.staggered) {
    for (const gles::BodySetup& body : setup.bodies) {
        volume_m3_.push_back(body.inside_out ? 0.0 : gles::mass_properties(body.shape).volume_m3);
        radius_m_.push_back(gles::bounding_radius_m(body.shape));
    }
    justified_.narrowing = narrowing;
    justified_.rest_speed_m_s = std::sqrt(glm::length(setup.gravity_m_s2) * tank_.longest_m());
    faster(largest(scene, scene.initial.velocity_m_s, 0.0));
    faster(falling_speed_m_s(setup));
    others_drive_ = scene.forcing || scene.temperature || (scene.smoke && scene.smoke->weight != 0.0);
    for (const Scene::Source& source : scene.sources) others_drive_ |= source.velocity_m_s.has_value();
    for (const Scene::Wall* wall : scene.tank.walls.all()) others_drive_ |= wall->velocity_m_s.has_value();
    if (scene.smoke) smoke_start_ = largest(scene, scene.smoke->initial);
    if (scene.temperature) heat_start_k_ = largest(scene, scene.temperature->initial_k);
}

void Ledger::give(double work_j) {
    if (!std::isfinite(work_j)) return;  // what is not a number justifies nothing
    justified_.work_j += work_j;
    justified_.given_j += std::max(0.0, work_j);
}

void Ledger::give_ahead(double work_j) {
    if (!std::isfinite(work_j)) return;
    give(work_j);
    justified_.ahead_j += work_j;
}

void Ledger::whole_tank(double& fastest_m_s, double speed_m_s) {
    if (!(speed_m_s > fastest_m_s)) return;
    give_ahead(0.5 * tank_.mass_kg() * (square(speed_m_s) - square(fastest_m_s)));
    fastest_m_s = speed_m_s;
}

void Ledger::add(double time_s, double dt_s, const std::vector<gles::BodyState>& bodies,
                 const std::vector<gles::Load>& loads) {
    add_bodies(dt_s, bodies, loads);
    add_sources(time_s - dt_s, dt_s);
    add_walls(time_s, dt_s);
    add_weight();
    // A force on all of the fluid may have sped all of it up, all the time.
    if (scene_.forcing) {
        const double speed = forcing_m_s_ + dt_s * largest(scene_, scene_.forcing->acceleration_m_s2, time_s);
        faster(speed);
        whole_tank(forcing_m_s_, speed);
    }
    // Confinement may carry the speed of what drives the fluid through all of the tank; it may not make more of it.
    if (scene_.vorticity_confinement) whole_tank(swirl_m_s_, justified_.speed_m_s);
}

void Ledger::add_bodies(double dt_s, const std::vector<gles::BodyState>& bodies,
                        const std::vector<gles::Load>& loads) {
    const double rho = setup_.density_kg_m3;
    double solid_j = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const gles::BodyState& body = bodies[i];
        const double radius = radius_m_.at(i);
        // Nothing that crosses the tank in less than a step is a movement that could be followed.
        const double limit = tank_.longest_m() / std::max(dt_s, scene_.solver.dt_s);
        double speed = glm::length(body.velocity_m_s) + glm::length(body.spin_rad_s) * radius;
        const double followed = speed > limit ? limit / speed : 1.0;
        speed *= followed;
        if (const auto& coupled = setup_.bodies[i].coupled; coupled && coupled->moves) {
            // What the fluid moves cannot justify itself: it falls or rises through the tank, and no faster.
            const double excess =
                std::abs(coupled->density_kg_m3 - rho) / (coupled->density_kg_m3 + 0.5 * rho);
            const double fall = std::sqrt(2.0 * excess) * justified_.rest_speed_m_s;
            faster(fall);
            whole_tank(weight_m_s_, fall);
            solid_j += around_j(i, std::min(speed, fall));
            continue;
        }
        faster(speed);
        solid_j += around_j(i, speed);
        // Cells that a body leaves keep its velocity: at most all that it swept.
        const double swept = std::min(std::numbers::pi * square(radius) * speed * dt_s, volume_m3_[i]);
        give(0.5 * rho * swept * square(speed));
        if (loads.empty()) {
            whole_tank(bodies_m_s_, speed);
            continue;
        }
        const double work = -dt_s * followed *
                            (glm::dot(loads.at(i).force_n, body.velocity_m_s) +
                             glm::dot(loads.at(i).torque_nm, body.spin_rad_s));
        // What it takes from a stream it may have from those who drive the stream, at the expense of nobody here.
        give(others_drive_ ? std::max(0.0, work) : work);
    }
    // Of what is in and on it less may be there: what it has at a time is not less when it goes.
    give_ahead(solid_j - solid_j_);
    solid_j_ = solid_j;
}

/// The rule counts solids with what they displace, at the speed of the solid; and cells that their surface cuts as fluid
/// alone, which is half a cell too much all around, at the 1.5 times the speed that passes a ball.
double Ledger::around_j(std::size_t i, double speed_m_s) const {
    const double skin_m3 = 4.0 * std::numbers::pi * square(radius_m_[i]) * 0.5 * tank_.cell_m;
    const double volume_m3 = volume_m3_[i] + skin_m3 * square(1.5 * justified_.narrowing);
    return 0.5 * setup_.density_kg_m3 * volume_m3 * square(speed_m_s);
}

void Ledger::add_sources(double time_s, double dt_s) {
    for (std::size_t i = 0; i < scene_.sources.size(); ++i) {
        const Scene::Source& source = scene_.sources[i];
        const bool runs = gles::is_running(setup_.sources.at(i), time_s);
        if (!runs) {
            running_[i] = false;
            continue;
        }
        justified_.smoke_added.high += dt_s * source.smoke_per_s.value_or(0.0);
        const double heat = dt_s * source.temperature_k_per_s.value_or(0.0);
        (heat < 0.0 ? justified_.temperature_added_k.low : justified_.temperature_added_k.high) += heat;
        if (!source.velocity_m_s) continue;
        const double speed = glm::length(*source.velocity_m_s);
        const double area = std::numbers::pi * square(source.radius_m);
        const double volume = 4.0 / 3.0 * std::numbers::pi * cube(source.radius_m);
        faster(speed);
        // Coming on, it sets off the ball of fluid and, over some steps, what that takes along: half as much, twice.
        if (!running_[i]) give_ahead(3.0 * 0.5 * setup_.density_kg_m3 * volume * square(speed));
        // Then it makes a stream: its momentum times its speed, and as much again for the pressure it works against.
        give(2.0 * setup_.density_kg_m3 * area * cube(speed) * dt_s);
        running_[i] = true;
    }
}

void Ledger::add_fields(double dt_s, const Fields& fields) {
    if (tank_.staggered) give(field_work_j(setup_, fields, dt_s));
}

void Ledger::add_walls(double time_s, double dt_s) {
    double fastest = 0.0;
    const auto walls = scene_.tank.walls.all();
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (!walls[i]->velocity_m_s) continue;
        const double speed = largest(scene_, *walls[i]->velocity_m_s, time_s);
        faster(speed);
        if (walls[i]->kind == WallKind::Inflow && inflow_seen_) continue;
        fastest = std::max(fastest, speed);
        if (walls[i]->kind != WallKind::Inflow) continue;
        // What comes in brings its energy, and works against the pressure.
        const glm::dvec3& size = scene_.tank.size_m;
        const double area = size.x * size.y * size.z / size[static_cast<int>(i / 2)];
        give(2.0 * square(justified_.narrowing) * 0.5 * setup_.density_kg_m3 * area * cube(speed) * dt_s);
    }
    whole_tank(walls_m_s_, fastest * justified_.narrowing);
}

void Ledger::add_weight() {
    const double gravity = glm::length(setup_.gravity_m_s2);
    double excess = 0.0;  // relative, of density
    if (scene_.smoke) excess += std::abs(scene_.smoke->weight) * (smoke_start_ + justified_.smoke_added.high);
    if (scene_.temperature)
        excess += std::abs(scene_.temperature->expansion_1_k) *
                  (heat_start_k_ +
                   std::max(justified_.temperature_added_k.high, -justified_.temperature_added_k.low));
    // Every drop of the tank may fall or rise once all the way through it.
    const double speed = std::sqrt(gravity * excess * tank_.longest_m());
    faster(speed);
    whole_tank(weight_m_s_, std::sqrt(2.0) * speed);
}

Justified Ledger::justified() const {
    return justified_;
}

std::vector<gles::Load> Ledger::at_rest() const {
    std::vector<gles::Load> loads(setup_.bodies.size());
    for (std::size_t i = 0; i < loads.size(); ++i)
        loads[i].force_n = -setup_.density_kg_m3 * volume_m3_[i] * setup_.gravity_m_s2;
    return loads;
}

}  // namespace eddy::stability
