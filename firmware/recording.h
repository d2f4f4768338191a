#pragma once
#include <optional>
#include <string>

#include "firmware/recorder.h"

namespace eddy {

/// What `--record` keeps of a run, if it was asked for. A disk that is full ends the recording, not the run.
class Recording {
  public:
    /// From now on, in this folder; empty: nothing is kept.
    void begin(const std::string& folder);

    bool on() const { return recorder_.has_value(); }
    void add(std::span<const TickRecord> ticks);
    void add(gles::Gpu& gpu, const gles::Texture& picture);
    /// Completes it.
    void finish();
    bool failed() const { return failed_; }
    const Recorder* recorder() const { return recorder_ ? &*recorder_ : nullptr; }

  private:
    std::optional<Recorder> recorder_;
    bool failed_ = false;
};

}  // namespace eddy
