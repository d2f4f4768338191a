#pragma once
#include <string>
#include <vector>

#include "gles/body/bounds.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// GLSL for the bodies of one scene; x in cells:
///   float solid_distance(vec3 x)    to the nearest body's surface, negative inside [cells]
///   int nearest_body(vec3 x)        its number
///   vec3 solid_velocity(vec3 x)     of the nearest body at x, as if it were rigidly extended [m/s]
/// Only the shapes this scene has are in it. The distance is exact, but for: an ellipsoid's, off by the order
/// of the distance squared; the inside of a paddle, where it is at most the true one; a mesh's
/// (distance_grid.h). None is more than the true one outside, so rays may step by it.
std::string shape_declarations(const std::vector<BodySetup>& bodies);

/// What these declarations read: the bodies' poses and motions, and the distances of meshes.
class BodyUniforms {
  public:
    BodyUniforms(Gpu& gpu, const std::vector<BodySetup>& bodies, double cell_m);
    void set(const std::vector<BodyState>& states);

    /// All of them; a pass takes what it uses.
    std::vector<Uniform> uniforms() const;
    /// The textures; they and their names live as long as this.
    const std::vector<Input>& inputs() const { return inputs_; }

  private:
    double cell_m_;
    std::vector<glm::vec3> centre_, size_;    ///< [cells]
    std::vector<glm::vec3> velocity_, spin_;  ///< [m/s]; angular velocity times cell width [m/s per cell]
    std::vector<glm::vec3> axes_;             ///< three for each body: its frame's axes in the tank
    std::vector<glm::vec3> handle_;           ///< of paddles: radius, half length [cells]
    std::vector<glm::dmat3> frames_;          ///< in the body: the frame in which its distance is written
    std::vector<std::string> input_names_;
    std::vector<TexturePool::Lease> distances_;
    std::vector<Input> inputs_;
};

}  // namespace eddy::gles
