#include "firmware/accuracy/face_velocity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eddy::accuracy {

FaceVelocity::FaceVelocity(const gles::Fluid& fluid)
    : cells_(fluid.setup().cells), cell_m_(fluid.setup().cell_m), u_(fluid.velocity()) {}

double FaceVelocity::at(const glm::ivec3& c, int k) const {
    return u_[static_cast<std::size_t>((c.z * (cells_.y + 1) + c.y) * (cells_.x + 1) + c.x)][k];
}

glm::dvec3 FaceVelocity::place_m(const glm::ivec3& c, int k) const {
    glm::dvec3 place = glm::dvec3(c) + 0.5;
    place[k] -= 0.5;
    return cell_m_ * place;
}

void FaceVelocity::for_each_face(const std::function<void(const glm::ivec3&, int, double)>& visit) const {
    for (int k = 0; k < 3; ++k) {
        glm::ivec3 end = cells_;
        ++end[k];
        for (int z = 0; z < end.z; ++z)
            for (int y = 0; y < end.y; ++y)
                for (int x = 0; x < end.x; ++x) {
                    const glm::ivec3 c(x, y, z);
                    visit(c, k, c[k] == 0 || c[k] == cells_[k] ? 0.5 : 1.0);
                }
    }
}

double FaceVelocity::fastest_m_s() const {
    float most = 0.0f;
    for (const glm::vec3& u : u_) {
        const float speed = glm::length(u);
        if (!std::isfinite(speed)) return std::numeric_limits<double>::quiet_NaN();
        most = std::max(most, speed);
    }
    return most;
}

double FaceVelocity::energy() const {
    double sum = 0.0;
    for_each_face(
        [&](const glm::ivec3& c, int k, double share) { sum += 0.5 * share * at(c, k) * at(c, k); });
    return sum / (cells_.x * cells_.y * cells_.z);
}

double FaceVelocity::mean_square_vorticity() const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        glm::ivec3 ei(0), ej(0), begin(0);
        ei[i] = ej[j] = 1;
        begin[i] = begin[j] = 1;
        for (int z = begin.z; z < cells_.z; ++z)
            for (int y = begin.y; y < cells_.y; ++y)
                for (int x = begin.x; x < cells_.x; ++x) {
                    const glm::ivec3 c(x, y, z);
                    const double curl = (at(c, j) - at(c - ei, j) - at(c, i) + at(c - ej, i)) / cell_m_;
                    sum += curl * curl;
                }
    }
    return sum / (cells_.x * cells_.y * cells_.z);
}

double relative_l2(const FaceVelocity& u, const VelocityFormula& exact) {
    double difference = 0.0, size = 0.0;
    u.for_each_face([&](const glm::ivec3& c, int k, double share) {
        const double expected = exact(u.place_m(c, k))[k], error = u.at(c, k) - expected;
        difference += share * error * error;
        size += share * expected * expected;
    });
    return std::sqrt(difference / size);
}

double amplitude(const FaceVelocity& u, const VelocityFormula& mode) {
    double product = 0.0, size = 0.0;
    u.for_each_face([&](const glm::ivec3& c, int k, double share) {
        const double m = mode(u.place_m(c, k))[k];
        product += share * m * u.at(c, k);
        size += share * m * m;
    });
    return product / size;
}

}  // namespace eddy::accuracy
