#pragma once
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

#include "gles/atlas.h"
#include "gles/gpu.h"
#include "gles/program.h"

namespace eddy::gles {

/// A texture under the name the shader reads it by.
struct Input {
    const char* name;
    const Texture* texture;
};

using UniformValue = std::variant<int, float, glm::vec2, glm::vec3, glm::vec4, glm::ivec3, glm::mat3,
                                  glm::mat4, std::vector<glm::vec3>, std::vector<glm::vec4>>;
struct Uniform {
    const char* name;
    UniformValue value;
};

/// Where a pass draws: the whole target, or only some boxes of it (in texels of its layout: x, y, slab).
/// Boxes are drawn after each other; a fragment in two boxes is computed twice and is the same.
class Region {
  public:
    static Region everything() { return Region{}; }
    explicit Region(std::vector<Box> boxes) : everything_(false), boxes_(std::move(boxes)) {}
    /// The texels of a 4-layer layout (Cells4, Faces4) that hold any cell of these boxes.
    static Region packed(std::vector<Box> boxes);
    bool is_everything() const { return everything_; }
    const std::vector<Box>& boxes() const { return boxes_; }

  private:
    Region() = default;
    bool everything_ = true;
    std::vector<Box> boxes_;
};

/// GLSL for a constant.
std::string glsl(const glm::ivec3& v);

/// What a variant of a shader is compiled with: layouts the shader names, and switches.
struct Variant {
    std::vector<std::pair<std::string, AtlasLayout>> layouts{};
    std::vector<std::pair<std::string, std::string>> defines{};
    std::string
        declarations{};  ///< GLSL put in front of the shader, for what only the scene knows (its shapes)
};

/// What becomes of what the target held.
enum class Onto {
    Replace,  ///< it is gone
    Over      ///< it shows through by 1 - alpha of what is drawn, whose colour holds its alpha already
};

/// One fragment shader drawn over a target. The shader's header says what it reads and writes, in which
/// units. Locations are looked up once at link. Start-up fails, with the name, when the shader does not
/// compile, or at the first draw when a uniform it uses is not given.
class Pass {
  public:
    /// `target` is the layout of everything it writes; shaders call it TARGET.
    Pass(Gpu& gpu, std::string name, std::string_view shader, const AtlasLayout& target,
         const Variant& variant = {});

    void draw(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms,
              const std::vector<const Texture*>& outputs, const Region& region = Region::everything(),
              Onto onto = Onto::Replace);

    const std::string& name() const { return name_; }

  private:
    const Program::Uniform* find(std::string_view name) const;
    void require_all_given(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms) const;

    Gpu* gpu_;
    std::string name_;
    std::string shader_;
    AtlasLayout target_;
    int fetches_;
    std::shared_ptr<const Program>
        program_;  ///< other passes may draw with it: all is given anew at each draw
    bool checked_ = false;
};

}  // namespace eddy::gles
