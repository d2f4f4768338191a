#include "gles/fluid/force_methods.h"

#include <algorithm>

#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// Cells between a body's box and the outer faces of the balance.
constexpr int kAround = 1;

glm::ivec3 unit(int axis) {
    return glm::ivec3(glm::mat3(1.0f)[axis]);
}

/// One step's fields, and what a sum over faces asks of them. A face is named by the cell above it and its axis. In units of
/// cells and of rho h^3 m/s.
struct Step {
    const FluidSetup& setup;
    const StepVelocities& u;
    const std::vector<glm::vec3>& shares_before;
    std::vector<glm::vec3> shares;
    std::vector<glm::vec4> owners;
    std::vector<float> phi;
    double lambda, time_s, dt_h;

    std::size_t index(const glm::ivec3& c) const {
        const glm::ivec3 size = setup.cells + 1;
        return static_cast<std::size_t>((c.z * size.y + c.y) * size.x + c.x);
    }
    double at(const std::vector<glm::vec3>& field, const glm::ivec3& c, int axis) const {
        return static_cast<double>(field[index(c)][axis]);
    }
    double share(const glm::ivec3& c, int axis) const { return at(shares, c, axis); }
    double potential(const glm::ivec3& c) const {
        return static_cast<double>(
            phi[static_cast<std::size_t>((c.z * setup.cells.y + c.y) * setup.cells.x + c.x)]);
    }
    int owner(const glm::ivec3& c, int channel) const { return static_cast<int>(owners[index(c)][channel]); }
    bool in_tank(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) && glm::all(glm::lessThan(c, setup.cells));
    }
    bool has_friction() const { return !u.diffused.empty(); }

    /// What the pressure made of the velocity on an open face.
    double pressed(const glm::ivec3& c, int k) const {
        if (!has_friction()) return at(u.after, c, k) - at(u.forced, c, k);
        return at(u.predicted, c, k) - at(u.forced, c, k) + at(u.after, c, k) - at(u.diffused, c, k);
    }
    /// What friction made of the momentum on a face.
    double rubbed(const glm::ivec3& c, int k) const {
        return has_friction() ? share(c, k) * (at(u.diffused, c, k) - at(u.predicted, c, k)) : 0.0;
    }
    /// What friction brought to a face from the next one in direction `way` along an axis, or from the wall there: the
    /// links of viscous.glsl.
    double link(const glm::ivec3& c, int k, int axis, int way) const;
    glm::dvec3 wall_velocity(int wall, const glm::dvec3& x_cells) const;
};

glm::dvec3 Step::wall_velocity(int wall, const glm::dvec3& x_cells) const {
    const WallSetup& w = setup.walls[static_cast<std::size_t>(wall)];
    return w.velocity_at ? w.velocity_at(setup.cell_m * x_cells, time_s) : glm::dvec3(0.0);
}

double Step::link(const glm::ivec3& c, int k, int axis, int way) const {
    if (!has_friction()) return 0.0;
    const glm::ivec3 to = c + way * unit(axis);
    const double here = at(u.diffused, c, k);
    if (axis != k && !in_tank(to)) {
        const int wall = 2 * axis + (way > 0 ? 1 : 0);
        const WallKind kind = setup.walls[static_cast<std::size_t>(wall)].kind;
        if (kind != WallKind::NoSlip && kind != WallKind::Inflow) return 0.0;
        glm::dvec3 x = glm::dvec3(c) + 0.5 - 0.5 * glm::dvec3(unit(k));
        x[axis] = way > 0 ? setup.cells[axis] : 0.0;
        return 2.0 * lambda * share(c, k) * (wall_velocity(wall, x)[k] - here);
    }
    const double there = share(to, k);
    return there > 0.0 ? 0.5 * lambda * (share(c, k) + there) * (at(u.diffused, to, k) - here) : 0.0;
}

/// The balance of momentum of the fluid in the cells of a box that are a body's own.
class Balance {
  public:
    Balance(const Step& step, int body, const Box& box) : step_(step), body_(body), box_(box) {}

    bool holds(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, box_.lo)) && glm::all(glm::lessThan(c, box_.hi)) &&
               step_.owner(c, 3) == body_;
    }
    /// Whether a face lies between two of them.
    bool encloses(const glm::ivec3& c, int k) const {
        return c[k] > 0 && step_.in_tank(c) && holds(c) && holds(c - unit(k));
    }

    void add(const glm::ivec3& c, int k) {
        const glm::ivec3 above = c + unit(k);
        const bool held = holds(c);
        const double p = step_.potential(c), low = step_.share(c, k), high = step_.share(above, k);
        if (encloses(c, k)) add_inner(c, k);
        if (held && !encloses(c, k)) force[k] += low * p;
        if (held && !encloses(above, k)) force[k] -= high * p;
        // Where bodies nearly touch, faces of one lie on cells of the other: the pressure on those changes sides.
        const auto other_side = [&](const glm::ivec3& face) {
            return static_cast<double>(step_.owner(face, k) == body_) - static_cast<double>(held);
        };
        force[k] += p * ((1.0 - high) * other_side(above) - (1.0 - low) * other_side(c));
    }

    glm::dvec3 force{0.0};
    glm::dvec3 transport{0.0};  ///< momentum after it, less momentum before and what flowed in

  private:
    void add_inner(const glm::ivec3& c, int k) {
        const Step& s = step_;
        const double share = s.share(c, k);
        transport[k] +=
            share * s.at(s.u.carried, c, k) - s.at(s.shares_before, c, k) * s.at(s.u.before, c, k);
        if (share > 0.0) force[k] -= share * s.pressed(c, k) + s.rubbed(c, k);
        for (int axis = 0; axis < 3; ++axis)
            for (const int way : {-1, 1}) {
                if (encloses(c + way * unit(axis), k)) continue;
                if (share > 0.0) force[k] += s.link(c, k, axis, way);
                transport[k] += way * s.dt_h * flux(c, k, axis, way);
            }
    }
    /// u_axis u_k between a face and the next one: their mean, and that of the two faces across it.
    double flux(const glm::ivec3& c, int k, int axis, int way) const {
        const std::vector<glm::vec3>& u = step_.u.before;
        const glm::ivec3 to = c + way * unit(axis), low = way > 0 ? to : c;
        const double carried =
            0.5 * (step_.at(u, c, k) + step_.at(u, glm::clamp(to, glm::ivec3(0), step_.setup.cells), k));
        if (axis == k) return carried * carried;
        return carried * 0.5 * (step_.at(u, low, axis) + step_.at(u, low - unit(k), axis));
    }

    const Step& step_;
    int body_;
    Box box_;
};

/// What a body gave the fluid at one face, and its weight on the tank's walls.
double impulse(const Step& s, int body, const glm::ivec3& c, int k) {
    double sum = 0.0;
    const glm::ivec3 above = c + unit(k);
    if (above[k] == s.setup.cells[k] && s.owner(above, k) == body)
        sum += (1.0 - s.share(above, k)) * s.potential(c);
    if (s.owner(c, k) != body) return sum;
    const double share = s.share(c, k);
    if (c[k] == 0) return sum - (1.0 - share) * s.potential(c);
    if (share <= 0.0) return sum + s.potential(c - unit(k)) - s.potential(c);
    sum += (1.0 - share) * s.pressed(c, k);
    bool touches = share != 1.0;
    double from_neighbours = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        for (const int way : {-1, 1}) {
            const glm::ivec3 to = c + way * unit(axis);
            touches = touches || (s.in_tank(to) && s.share(to, k) != 1.0);
            from_neighbours += s.link(c, k, axis, way);
        }
    return touches ? sum - (s.rubbed(c, k) - from_neighbours) : sum;
}

}  // namespace

ForceMethodsPass::ForceMethodsPass(Gpu& gpu, const FluidSetup& setup)
    : setup_(setup),
      owners_(gpu, "owners", "gles/body/owners.frag", Faces::layout(setup.cells),
              {.declarations = shape_declarations(setup.bodies)}),
      owner_field_(gpu, setup.cells, Format::RGBA32F) {}

void ForceMethodsPass::keep(Which which, const Field<Faces>& u) {
    u_.*which = unpack_vectors(u.texture().download(), u.layout());
}

void ForceMethodsPass::add_up(const Field<Cells4>& phi, const FaceFractions& a, const BodyUniforms& uniforms,
                              const std::vector<Box>& boxes, double time_s, double dt_s) {
    owners_.draw(uniforms.inputs(), uniforms.uniforms(), {&owner_field_.texture()});
    std::vector<glm::vec3> shares = a.download();
    if (shares_before_.empty()) shares_before_ = shares;
    const Step step{setup_,
                    u_,
                    shares_before_,
                    std::move(shares),
                    unpack_texels(owner_field_.texture().download(), owner_field_.layout()),
                    unpack_four(phi.texture().download(), phi.layout(), setup_.cells),
                    static_cast<double>(diffusion_number(setup_, dt_s)),
                    time_s,
                    dt_s / setup_.cell_m};
    const double h = setup_.cell_m, newton = setup_.density_kg_m3 * h * h * h / dt_s;
    forces_.clear();
    for (std::size_t body = 0; body < boxes.size(); ++body) {
        const Box box = boxes[body].grow(kAround).intersect({glm::ivec3(0), setup_.cells});
        Balance balance(step, static_cast<int>(body), box);
        glm::dvec3 impulses(0.0);
        for (int z = box.lo.z; z < box.hi.z; ++z)
            for (int y = box.lo.y; y < box.hi.y; ++y)
                for (int x = box.lo.x; x < box.hi.x; ++x)
                    for (int k = 0; k < 3; ++k) {
                        balance.add({x, y, z}, k);
                        impulses[k] += impulse(step, static_cast<int>(body), {x, y, z}, k);
                    }
        forces_.push_back({newton * balance.force, newton * impulses, newton * balance.transport});
    }
    shares_before_ = step.shares;
}

}  // namespace eddy::gles
