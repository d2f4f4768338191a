#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gles/context.h"
#include "gles/program.h"
#include "gles/texture.h"

namespace eddy::gles {

/// What one pass was asked to do, for the plan (`eddy simulate --plan`), the bench and the tests.
struct PassRecord {
    std::string stage;  ///< the line of the step it belongs to
    std::string pass;
    std::vector<std::string> inputs;    ///< sampler names
    std::vector<std::string> uniforms;  ///< given a value, besides where to draw
    std::vector<const Texture*> outputs;
    int draws = 0;             ///< draw calls: one, or one for each box that is not empty
    std::int64_t texels = 0;   ///< texels written (one per fragment, whatever the number of outputs)
    std::int64_t bytes = 0;    ///< bytes written
    std::int64_t fetches = 0;  ///< texture fetches, as declared by the shader
};

/// Returns when the GPU has done everything it was asked to: for those who measure. Others take Gpu::finish().
void finish();

/// What follows a pause.
enum class Next {
    Compiling,  ///< the driver may compile: some take minutes for it, and nothing can be said meanwhile
    Work        ///< anything else
};

/// The one place where GL state lives: textures, framebuffers, and who watches the passes go by.
class Gpu {
  public:
    explicit Gpu(const Capabilities& capabilities);
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    const Capabilities& capabilities() const { return capabilities_; }
    TexturePool& textures() { return textures_; }
    ProgramCache& programs() { return programs_; }
    /// Whether passes may sample 32-bit textures linearly; tests turn it off to try the other path.
    bool filters_float() const { return filters_float_; }
    void set_filters_float(bool on) { filters_float_ = on && capabilities_.filters_float; }

    /// Framebuffer with these colour attachments (0 to 3), made once.
    unsigned framebuffer(const std::vector<const Texture*>& targets);
    std::size_t framebuffers() const { return framebuffers_.size(); }
    /// Gives back to the driver the textures of the pool that nobody holds: after work on other grids than those that go on. What
    /// a fluid that goes on needs for a step only, its next step makes anew.
    void free_idle_textures();

    /// While a Stage lives, passes are recorded under its name, and the watcher hears its begin and end.
    class Stage {
      public:
        Stage(Gpu& gpu, std::string_view name);
        ~Stage();
        Stage(const Stage&) = delete;
        Stage& operator=(const Stage&) = delete;

      private:
        Gpu& gpu_;
        std::string outer_;
    };
    using StageWatcher = std::function<void(std::string_view stage, bool begins)>;
    void watch_stages(StageWatcher watcher) { watcher_ = std::move(watcher); }

    /// `between` is called in the middle of long work, often: before a pass is compiled, before it draws for the first time
    /// (drivers put off a part of compiling until then), at the begin of each stage, and each tenth of a second of waiting for the
    /// GPU. It may draw with passes of its own, of which it does not hear, and may throw if the work is to be given up. Empty: nobody
    /// is called.
    void on_pause(std::function<void(Next)> between) { between_ = std::move(between); }
    void pause(Next next = Next::Work);

    /// A GPU that has not done in this time what it was asked to is not slow, it hangs; but the driver may have had to compile.
    static constexpr std::chrono::seconds kPatience{120};
    /// The same when nothing was compiled, or drawn for the first time, since the last finish().
    static constexpr std::chrono::seconds kCompiledPatience{10};
    std::chrono::seconds patience() const { return may_compile_ ? kPatience : kCompiledPatience; }
    /// Returns when the GPU has done everything it was asked to, with pauses; none any more once it hangs.
    void finish();
    /// Until the fence (a GLsync) has passed, with pauses. False: it has not, in so long, or was lost.
    bool wait(void* fence, std::chrono::nanoseconds patience);

    /// Records every pass from now on into `records` (null: stop).
    void record(std::vector<PassRecord>* records) { records_ = records; }
    void note(PassRecord record);
    bool recording() const { return records_ != nullptr; }

  private:
    Capabilities capabilities_;
    bool filters_float_;
    TexturePool textures_;
    ProgramCache programs_;
    unsigned vertex_array_ = 0;
    std::map<std::vector<std::uint64_t>, unsigned> framebuffers_;  // by the serials of their textures
    std::string stage_;
    StageWatcher watcher_;
    std::function<void(Next)> between_;
    bool pauses_ = false;
    bool may_compile_ = false;  ///< since the last finish()
    std::vector<PassRecord>* records_ = nullptr;
};

}  // namespace eddy::gles
