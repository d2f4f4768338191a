#pragma once
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace eddy::gles {

/// A linked GL program and where its uniforms are.
class Program {
  public:
    /// What it is made of: a fragment shader under the vertex shader of all passes.
    struct Source {
        std::string shader;        ///< path of the fragment shader
        std::string switches;      ///< its #defines
        std::string declarations;  ///< GLSL put in front of it
        std::string target;        ///< the same of the vertex shader
        bool operator==(const Source&) const = default;
    };
    struct Uniform {
        std::string name;
        int location;  ///< of a sampler: its texture unit, which never changes
        bool is_sampler;
    };

    /// Throws GlError, with the driver's complaints placed in our files, if it does not compile.
    explicit Program(const Source& source);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    unsigned id() const { return id_; }
    int rect() const { return rect_; }
    int first_slab() const { return first_slab_; }
    /// But for those two.
    const std::vector<Uniform>& uniforms() const { return uniforms_; }

  private:
    unsigned id_ = 0;
    int rect_ = -1, first_slab_ = -1;
    std::vector<Uniform> uniforms_;
};

/// Compiling takes a driver long. What has been compiled is kept, so that a second fluid of the same kind
/// (another preset, the next run of a study) has it at once.
class ProgramCache {
  public:
    std::shared_ptr<const Program> get(const Program::Source& source);
    /// Programs linked since start.
    std::size_t linked() const { return linked_; }

  private:
    struct Entry {
        Program::Source source;
        std::shared_ptr<const Program> program;
    };
    std::list<Entry> entries_;  ///< the last used first
    std::size_t linked_ = 0;
};

}  // namespace eddy::gles
