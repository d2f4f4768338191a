#pragma once
#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

// What the shapes' shaders and formulas are compared with: slow, and written down in another way. x in the
// body's frame. Not for meshes.

bool is_inside(const Shape& shape, const glm::dvec3& x);
/// Signed distance, negative inside, right to a millionth of the shape's size.
double exact_distance(const Shape& shape, const glm::dvec3& x);

/// One of each shape, of sizes between 1 and 9, with its name.
struct NamedShape {
    std::string name;
    Shape shape;
};
std::vector<NamedShape> closed_form_shapes();

using Random = std::mt19937_64;
/// Uniform in [low, high]^3.
glm::dvec3 random_point(Random& random, double low, double high);
glm::dquat random_turn(Random& random);

}  // namespace eddy::gles
