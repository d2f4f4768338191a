#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/exhibit/notice.h"
#include "firmware/exhibit/playbill.h"
#include "firmware/screen.h"

namespace eddy {

/// What visitors see: the screen and, on it, the act that is played, or words where there is none. After a reset of the GPU it
/// makes everything anew; meanwhile the hand's side goes on without it. GL thread only.
class Front {
  public:
    /// `screen_memory`: the file that keeps which screen was used last; empty: none. `most_px`: pictures are drawn no larger;
    /// 0: as large as the screen.
    Front(std::unique_ptr<Graphics> graphics, HandSide& hand, std::filesystem::path screen_memory,
          long most_px);

    /// Another act is to follow, in pictures of the screen's shape.
    void announce(const Scene& scene, Act::Setup setup);
    bool preparing() const { return playbill_->something_announced(); }
    /// A piece of what the announced act needs; see Playbill::work().
    std::optional<Playbill::News> prepare(const std::function<bool()>& meanwhile = {});
    bool plays() const { return playbill_->plays(); }
    Act& act() { return playbill_->act(); }
    const Act& act() const { return playbill_->act(); }

    /// Once each turn, picture or not. Moved or Lost: only a new process can help. Throws gles::GlError if the GPU does not come back.
    DisplayState poll(Instant now);
    bool has_screen() const { return screen_->size_px().has_value(); }
    bool wants_picture() const { return screen_->wants_picture(); }
    /// Draws the act, or the words, and shows it if there is a screen.
    const gles::Texture& show_act(Instant now, const std::string& caption);
    const gles::Texture& show_words(const std::vector<std::string>& lines, Instant now);
    /// Words were shown, or would have been if there were a screen.
    bool has_shown_words() const { return has_shown_words_; }
    /// In place of poll() and show_words() in the middle of prepare(), as often as one likes: shows them when a picture is due. False: the
    /// GPU was reset, and what is being prepared is lost.
    bool wait(const std::vector<std::string>& lines, Instant now);
    /// Opening hours.
    void set_awake(bool awake) { screen_->set_awake(awake); }

    const Graphics& graphics() const { return *graphics_; }
    gles::Gpu& gpu() { return graphics_->gpu; }
    std::uint64_t gpu_resets() const { return gpu_resets_; }
    /// Something new to say of the screen.
    std::optional<Screen::News> news() { return screen_->news(); }

  private:
    void make();
    void recover();

    HandSide& hand_;
    const std::filesystem::path screen_memory_;
    const long most_px_;
    std::unique_ptr<Graphics> graphics_;
    std::unique_ptr<Screen> screen_;
    std::unique_ptr<Playbill> playbill_;
    std::unique_ptr<Notice> notice_;
    struct Announced {
        Scene scene;
        Act::Setup setup;
    };
    std::optional<Announced> playing_, next_;
    std::uint64_t gpu_resets_ = 0;
    bool has_shown_words_ = false;
    Instant wait_due_{0};  ///< the next picture of wait()
};

}  // namespace eddy
