#pragma once
#include <array>
#include <glm/glm.hpp>
#include <string_view>

namespace eddy::emulated {

/// Which axis of a recording, and with which sign, each axis of the Device frame takes: "x,z,-y" means device
/// x = source x, device y = source z, device z = -source y. That one turns recordings with z up into the
/// Device frame.
class AxisMap {
  public:
    /// Throws std::invalid_argument with a sentence unless the text names each of x, y, z once.
    explicit AxisMap(std::string_view text);

    glm::dvec3 operator()(const glm::dvec3& source) const;

  private:
    struct Term {
        glm::dvec3::length_type axis;
        double sign;
    };
    std::array<Term, 3> terms_{};
};

}  // namespace eddy::emulated
