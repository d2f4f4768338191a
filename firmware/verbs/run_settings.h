#pragma once
#include <optional>
#include <string>
#include <utility>

#include "firmware/exhibit/config_intake.h"
#include "firmware/exhibit/office.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

/// With which settings a run is played, and how it comes to others: what lies in the folder, tried before it counts, the act that it
/// asks for made ready by somebody else.
///
///     heed()                        now and then, in pauses of long work too -> news(), wants_another_act()
///     announce() -> make it ready -> began() or failed()
class RunSettings {
  public:
    /// The first settings of which a show can be made. Throws InputError or ConfigError for orders of the command line that cannot be
    /// carried out. `office` and `clock` must outlive this.
    RunSettings(const RunOptions& options, const ConfigIntake::Setup& setup, Office& office,
                const Clock& clock);

    const Exhibit& exhibit() const { return exhibit_; }
    const Scene& scene() const { return scene_; }
    const ConfigReport& report() const { return intake_.report(); }
    bool good() const { return good_; }                ///< the last that were read were taken
    double taken_at_s() const { return taken_at_s_; }  ///< UTC since 1970; 0: never

    /// Looks into the folder.
    void heed();
    bool is_held_up(Instant now) const { return intake_.is_held_up(now); }
    struct News {
        bool apply = false;  ///< keys that count at once may be others
        bool taken = false, refused = false;
    };
    /// Since the last call.
    News news() { return std::exchange(news_, {}); }

    /// Another act is to follow than was announced last.
    bool wants_another_act() const { return offer_ && !announced_; }
    struct Wish {
        const Exhibit exhibit;
        const Scene& scene;
    };
    /// From now on that is being made ready.
    Wish announce();
    /// The act announced plays from now on, after so much work; or the same again, after a reset of the GPU.
    void began(Seconds work);
    /// It cannot. Throws gles::GlError if nothing else is left to play.
    void failed(const std::string& why);

    void stopped() { intake_.stopped(); }

  private:
    void choose();
    /// If more was refused than before.
    void tell_what_is_wrong(std::uint64_t refused);
    void take(ConfigOffer offer);
    void overtake(ConfigOffer offer);
    void taken(const ConfigOffer& offer);
    void refuse(const ConfigOffer& offer, const std::string& why);
    bool nothing_runs() const { return report().running_hash.empty(); }

    const RunOptions options_;
    Office& office_;
    const Clock& clock_;
    ConfigIntake intake_;
    Exhibit exhibit_;
    Scene scene_;
    std::optional<ConfigOffer> offer_;  ///< that is being made ready
    bool announced_ = false;            ///< it was
    News news_;
    bool good_ = true;
    double taken_at_s_ = 0.0;
};

}  // namespace eddy
