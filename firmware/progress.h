#pragma once
#include <chrono>
#include <string>

namespace eddy {

/// One line on standard error that says how far long work has come: rewritten in place on a terminal, a line
/// every ten seconds elsewhere. Silent for work shorter than a second.
class Progress {
  public:
    explicit Progress(std::string what) : what_(std::move(what)) {}
    ~Progress() { finish(); }
    /// done of total, in whatever unit; `note` is appended.
    void show(double done, double total, const std::string& note = "");
    /// Ends the line. Called by the destructor.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    bool open_ = false;
};

}  // namespace eddy
