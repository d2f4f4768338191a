#pragma once
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/display/display.h"
#include "hal/display/kms/card.h"
#include "hal/display/kms/choice.h"
#include "hal/display/kms/flip_watch.h"
#include "hal/display/kms/found_state.h"
#include "hal/display/kms/output.h"
#include "hal/display/kms/pacer.h"

namespace eddy::kms {

/// No screen can be driven: what, where, and what to try.
struct KmsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Whether the machine has a card that KmsDisplay could open: drivers may bring one up well after the program does.
bool has_card(Machine& machine);

/// The whole screen, straight from the kernel: no compositor, no cursor, no console. Opened once, it copes by itself with
/// monitors that come and go, cards that refuse, flips that never come, and programs that take the screen; poll() says how it is.
class KmsDisplay final : public Display {
  public:
    /// Opens the card that has a monitor, else the first that has plugs. A monitor, or the right to use the screen, may come
    /// later. Throws KmsError if no card can be opened.
    KmsDisplay(std::unique_ptr<Machine> machine, Wish wish);
    /// Puts back what was on the screen at the start.
    ~KmsDisplay() override;

    unsigned egl_platform() const override;
    void* native_display() const override;
    void* native_window() const override;
    std::optional<SizePx> size_px() const override;
    long window_number() const override { return window_number_; }
    void refuse_window() override;
    DisplayState poll(Instant now) override;
    bool wants_frame() const override;
    void present() override;
    void set_awake(bool awake) override;
    DisplayCounters counters() const override { return counters_; }
    std::string problem() const override { return problem_; }
    std::string screen_id() const override { return monitor_ ? monitor_->id : ""; }
    std::string describe() const override;

  private:
    /// A way to show a picture on a monitor; tried in turn until the card takes one.
    struct Attempt {
        ChosenMode mode;
        std::uint32_t format = 0;
        Layout layout = Layout::Own;
        bool atomic = false;
    };
    /// A window whose buffers may still be in use by the card or by GL.
    struct OldWindow {
        std::unique_ptr<Window> window;
        Card* card = nullptr;  ///< that the framebuffers belong to
        std::vector<std::uint32_t> framebuffers;
    };
    /// A picture that GL has finished.
    struct Frame {
        Window* window = nullptr;
        const Buffer* buffer = nullptr;
        explicit operator bool() const { return buffer != nullptr; }
    };

    // Start-up, in this order: card; connector, mode, CRTC and plane; window; the first frame is sent by send().
    void open_card();
    void attach(std::vector<Monitor> monitors);
    std::vector<Attempt> attempts() const;
    void next_window();

    // What poll() does, in this order.
    void watch_master();
    void take_events();
    void cure();
    void watch_plugs();
    void fall_asleep();
    void wake_up();
    void send_waiting();

    DisplayState state() const;
    void look_again(bool probe);
    void look_at_other_cards();
    void send(Frame frame);
    void refused(Frame frame, int error, bool setting_mode);
    void lose_master();
    void reopen();
    void use(std::unique_ptr<Card> card);
    /// `Leave`: the card does not answer, and would hold us up.
    enum class Off { Switch, Leave };
    void detach(const std::string& problem, Off off = Off::Switch);
    Machine::Opened open(const std::string& path);
    void give_up(const std::string& problem);
    int framebuffer_of(const Frame& frame, std::uint32_t& id);
    static void drop(Frame& frame);
    /// What was on its way never came, or came unseen: it may be on the screen, so GL must not draw into it yet.
    void flying_is_stuck();
    void retire_window();
    /// A flip that is on its way gets the time of a frame to arrive; false if it did not.
    bool settle();
    static void remove_framebuffers(OldWindow& old);
    std::string no_monitor_problem(const std::vector<Monitor>& monitors) const;

    std::unique_ptr<Machine> machine_;
    Wish wish_;
    std::string path_;
    std::unique_ptr<Card> drawing_card_;  ///< the first that was opened: GL draws in its memory to the end
    std::unique_ptr<Card> reopened_;      ///< shows in its place, if there is one
    std::unique_ptr<WindowMaker> windows_;
    Card* card_ = nullptr;  ///< shows

    std::optional<Monitor> monitor_;
    std::optional<Output> output_;
    std::vector<Attempt> attempts_;
    std::size_t attempt_ = 0;
    std::unique_ptr<Window> window_;
    long window_number_ = 0;
    std::vector<OldWindow> old_windows_;
    std::map<const Buffer*, std::uint32_t> framebuffers_;  ///< of window_
    std::optional<FoundState> found_;
    std::set<std::uint32_t> touched_;  ///< CRTCs that found_ is to be put back on

    bool mode_is_set_ = false;
    Frame shown_, flying_, waiting_;
    std::vector<Frame> stuck_;
    Instant sent_{0};  ///< when flying_ was, on the card's clock

    Instant now_{0};
    bool awake_ = true, dark_ = false, master_ = true, lost_ = false, moved_ = false;
    std::optional<Instant> sleep_again_;  ///< it could not be switched off: then that is tried again
    bool look_due_ = false, look_probes_ = false;
    Instant master_try_{0}, plugs_poll_{0};
    std::optional<Instant> plugs_settled_;  ///< plugs changed; look into it then
    struct Waking {
        Instant since{0}, next_try{0};
        bool trying = false;      ///< a frame may be sent
        bool tried = false;       ///< once at least
        bool needs_edid = false;  ///< it had one in the evening
    };
    std::optional<Waking> waking_;
    FlipWatch watch_;
    Pacer pacer_;
    DisplayCounters counters_;
    std::string problem_;
};

}  // namespace eddy::kms
