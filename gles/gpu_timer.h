#pragma once
#include <optional>

namespace eddy::gles {

/// How long the GPU itself worked between begin() and end(), by EXT_disjoint_timer_query; only where
/// Capabilities::timer_query says that there is one.
class GpuTimer {
  public:
    GpuTimer();
    ~GpuTimer();
    GpuTimer(const GpuTimer&) = delete;
    GpuTimer& operator=(const GpuTimer&) = delete;

    void begin();
    void end();
    /// Waits for the GPU. [ms]; nothing if something else disturbed its clock (sleep, another frequency).
    std::optional<double> milliseconds();

  private:
    unsigned query_ = 0;
};

}  // namespace eddy::gles
