#include "tests/gles/reference.h"

#include <algorithm>
#include <cmath>

namespace eddy {
namespace {

constexpr glm::ivec3 kAxis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

template <class F>
void for_cells(const glm::ivec3& n, F f) {
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i) f(i, j, k);
}

}  // namespace

ReferenceFluid::ReferenceFluid(const glm::ivec3& cells)
    : n(cells),
      u(static_cast<std::size_t>((n.x + 1) * (n.y + 1) * (n.z + 1)), glm::dvec3(0.0)),
      phi(static_cast<std::size_t>(n.x * n.y * n.z), 0.0) {}

double ReferenceFluid::volume_share(const glm::dvec3& x) const {
    if (radius <= 0.0) return 1.0;
    const glm::dvec3 d = x - centre;
    double distance = glm::length(d) - radius;
    if (std::abs(distance) > 1.0) return distance > 0.0 ? 1.0 : 0.0;
    // Normal and curvature by differences over half a cell, as for shapes that have no closed form.
    glm::dvec3 g;
    double laplacian = -6.0 * distance;
    for (int a = 0; a < 3; ++a) {
        const double high = glm::length(d + 0.25 * glm::dvec3(kAxis[a])) - radius,
                     low = glm::length(d - 0.25 * glm::dvec3(kAxis[a])) - radius;
        g[a] = 2.0 * (high - low);
        laplacian += high + low;
    }
    distance += std::clamp(16.0 * laplacian, -2.0, 2.0) / 24.0;
    distance /= glm::length(g);
    const glm::dvec3 m = glm::max(glm::abs(glm::normalize(g)), glm::dvec3(0.3));
    const auto cube = [](double v) { return v > 0.0 ? v * v * v : 0.0; };
    const double alpha = distance + 0.5 * (m.x + m.y + m.z);
    double volume = cube(alpha) - cube(alpha - m.x) - cube(alpha - m.y) - cube(alpha - m.z) +
                    cube(alpha - m.x - m.y) + cube(alpha - m.y - m.z) + cube(alpha - m.z - m.x) -
                    cube(alpha - m.x - m.y - m.z);
    volume /= 6.0 * m.x * m.y * m.z;
    return volume < 1e-4 ? 0.0 : std::min(volume, 1.0);
}

double ReferenceFluid::fraction(int a, const glm::dvec3& x) const {
    const double here = volume_share(x);
    const auto gain = [&](double there) { return 0.25 * (here - there) * std::min(here, there); };
    return here + gain(volume_share(x + glm::dvec3(kAxis[a]))) + gain(volume_share(x - glm::dvec3(kAxis[a])));
}

double ReferenceFluid::open(int a, int i, int j, int k) const {
    const glm::ivec3 c(i, j, k);
    if (c[a] == 0 || c[a] == n[a]) return 0.0;
    return fraction(a, glm::dvec3(c) + 0.5 * (1.0 - glm::dvec3(kAxis[a])));
}

double ReferenceFluid::flux(int a, int i, int j, int k) const {
    const glm::ivec3 c(i, j, k);
    if (c[a] == 0 || c[a] == n[a]) return 0.0;
    const glm::dvec3 x = glm::dvec3(c) + 0.5 * (1.0 - glm::dvec3(kAxis[a]));
    const double f = fraction(a, x);
    return f * u[face(i, j, k)][a] + (1.0 - f) * solid_velocity(x)[a];
}

double ReferenceFluid::divergence(int i, int j, int k) const {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a)
        sum += flux(a, i + kAxis[a].x, j + kAxis[a].y, k + kAxis[a].z) - flux(a, i, j, k);
    return sum;
}

double ReferenceFluid::sample(int component, const glm::dvec3& s) const {
    const glm::dvec3 p = glm::clamp(s, glm::dvec3(0.5), glm::dvec3(n + 1) - 0.5) - 0.5;
    const glm::ivec3 low(glm::floor(p));
    const glm::dvec3 f = p - glm::dvec3(low);
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
        const glm::ivec3 d(c & 1, (c >> 1) & 1, c >> 2), at = glm::min(low + d, n);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(d));
        sum += w.x * w.y * w.z * u[face(at.x, at.y, at.z)][component];
    }
    return sum;
}

void ReferenceFluid::advect(double dt) {
    std::vector<glm::dvec3> next = u;
    const auto clamped = [&](int i, int j, int k) {
        return u[face(std::min(i, n.x), std::min(j, n.y), std::min(k, n.z))];
    };
    for_cells(n + 1, [&](int i, int j, int k) {
        const glm::dvec3 low = u[face(i, j, k)];
        const glm::dvec3 v =
            0.5 * (low + glm::dvec3(clamped(i + 1, j, k).x, clamped(i, j + 1, k).y, clamped(i, j, k + 1).z));
        const glm::dvec3 s = glm::dvec3(i, j, k) + 0.5 - dt * v;
        next[face(i, j, k)] = {sample(0, s), sample(1, s), sample(2, s)};
    });
    u = next;
}

void ReferenceFluid::project(double tolerance) {
    // -A phi = -b with A the fraction-weighted Laplacian: symmetric, positive semi-definite.
    std::vector<double> r(phi.size()), p, q(phi.size());
    const auto apply = [&](const std::vector<double>& x, std::vector<double>& y) {
        for_cells(n, [&](int i, int j, int k) {
            double sum = 0.0;
            for (int a = 0; a < 3; ++a)
                for (int side = 0; side < 2; ++side) {
                    const glm::ivec3 f = glm::ivec3(i, j, k) + side * kAxis[a];
                    const glm::ivec3 nb = glm::ivec3(i, j, k) + (2 * side - 1) * kAxis[a];
                    if (const double w = open(a, f.x, f.y, f.z); w > 0.0)
                        sum += w * (x[cell(i, j, k)] - x[cell(nb.x, nb.y, nb.z)]);
                }
            y[cell(i, j, k)] = sum;
        });
    };
    std::fill(phi.begin(), phi.end(), 0.0);
    for_cells(n, [&](int i, int j, int k) { r[cell(i, j, k)] = -divergence(i, j, k); });
    p = r;
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    };
    double rr = dot(r, r);
    const double stop = rr * tolerance * tolerance;
    for (int iteration = 0; iteration < 2000 && rr > stop; ++iteration) {
        apply(p, q);
        const double alpha = rr / dot(p, q);
        for (std::size_t i = 0; i < phi.size(); ++i) {
            phi[i] += alpha * p[i];
            r[i] -= alpha * q[i];
        }
        const double next = dot(r, r);
        for (std::size_t i = 0; i < phi.size(); ++i) p[i] = r[i] + next / rr * p[i];
        rr = next;
    }

    std::vector<glm::dvec3> projected = u;
    for_cells(n, [&](int i, int j, int k) {
        for (int a = 0; a < 3; ++a) {
            const glm::ivec3 c(i, j, k), below = c - kAxis[a];
            double& v = projected[face(i, j, k)][a];
            if (c[a] == 0)
                v = 0.0;
            else if (open(a, i, j, k) > 0.0)
                v -= phi[cell(i, j, k)] - phi[cell(below.x, below.y, below.z)];
            else
                v = solid_velocity(glm::dvec3(c) + 0.5 * (1.0 - glm::dvec3(kAxis[a])))[a];
        }
    });
    // The layers at the upper walls: no flow through them, and copies of the neighbour along them.
    for_cells(n + 1, [&](int i, int j, int k) {
        const glm::ivec3 c(i, j, k), m = glm::min(c, n - 1);
        if (c == m) return;
        for (int a = 0; a < 3; ++a) {
            glm::ivec3 from = m;
            from[a] = c[a];
            projected[face(i, j, k)][a] = c[a] == n[a] ? 0.0 : projected[face(from.x, from.y, from.z)][a];
        }
    });
    u = projected;
}

glm::dvec3 ReferenceFluid::force() const {
    glm::dvec3 sum(0.0);
    for_cells(n, [&](int i, int j, int k) {
        for (int a = 0; a < 3; ++a) {
            const glm::dvec3 half = 0.5 * (1.0 - glm::dvec3(kAxis[a])), low = glm::dvec3(i, j, k) + half;
            sum[a] += phi[cell(i, j, k)] * (fraction(a, low) - fraction(a, low + glm::dvec3(kAxis[a])));
        }
    });
    return sum;
}

glm::dvec3 ReferenceFluid::torque() const {
    glm::dvec3 sum(0.0);
    for_cells(n, [&](int i, int j, int k) {
        glm::dvec3 f(0.0);
        for (int a = 0; a < 3; ++a) {
            const glm::dvec3 half = 0.5 * (1.0 - glm::dvec3(kAxis[a])), low = glm::dvec3(i, j, k) + half;
            f[a] = phi[cell(i, j, k)] * (fraction(a, low) - fraction(a, low + glm::dvec3(kAxis[a])));
        }
        sum += glm::cross(glm::dvec3(i, j, k) + 0.5 - centre, f);
    });
    return sum;
}

}  // namespace eddy
