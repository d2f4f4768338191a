#pragma once
#include <string>
#include <vector>

#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// GLSL for the bodies of one scene: `float solid_distance(vec3 x)` (signed, negative inside, to the nearest
/// body) and `vec3 solid_velocity(vec3 x)` (of the nearest body at x, as if it were rigidly extended). x in
/// cells, result in cells and m/s. Only the shapes this scene has are in it.
std::string shape_declarations(const std::vector<BodySetup>& bodies);

/// Values of the uniforms that these declarations use. Everything in cells and m/s.
class BodyUniforms {
  public:
    BodyUniforms(const std::vector<BodySetup>& bodies, double cell_m);
    void set(const std::vector<BodyState>& states);
    Uniform centre() const { return {"body_centre", centre_}; }        ///< [cells]
    Uniform size() const { return {"body_size", size_}; }              ///< shape parameters [cells]
    Uniform velocity() const { return {"body_velocity", velocity_}; }  ///< [m/s]
    Uniform spin() const {
        return {"body_spin", spin_};
    }  ///< angular velocity times cell width [m/s per cell]

  private:
    double cell_m_;
    std::vector<glm::vec3> centre_, size_, velocity_, spin_;
};

/// Radius of the sphere around the body's centre that holds it [m].
double bounding_radius_m(const Shape& shape);
/// The cells in which the body's presence can be noticed: its bounding box and two cells around it, inside
/// the grid.
Box body_box(const Shape& shape, const BodyState& state, double cell_m, const glm::ivec3& cells);

}  // namespace eddy::gles
