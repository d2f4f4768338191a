#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gles/gpu.h"

namespace eddy {

/// Times in ms of repeated work: processor time of the whole process (what a software rasteriser costs,
/// however busy the machine is) and wall time.
struct Timings {
    std::vector<double> cpu_ms, wall_ms;
    std::vector<double> gpu_ms{};  ///< of the GPU alone, where that is measured
    bool empty() const { return wall_ms.empty(); }
};

/// The clock that tells best what a step costs: the GPU's own where it has one, or the processor's where the processor does
/// the drawing, however busy the machine is.
enum class CostClock { Gpu, Cpu, Wall };
const char* to_string(CostClock clock);
const std::vector<double>& by(CostClock clock, const Timings& times);

/// The value in the middle (of an even number: the upper of the two); 0 of none.
double median(std::vector<double> values);
/// The least value that 95 % of them do not exceed; 0 of none.
double percentile_95(std::vector<double> values);
/// The same for any share of them in %.
double percentile(std::vector<double> values, std::size_t percent);

/// Times stages of a step while it is on: waits for the GPU at each stage's begin and end, so that a stage is
/// charged with its own work and nothing else. That waiting costs; time whole steps without it. Of several, one is on at a time.
class Stopwatch {
  public:
    explicit Stopwatch(gles::Gpu& gpu);
    ~Stopwatch();
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

    /// Turned on, it adds what each stage takes to one sample, however often it runs; turned on again, to the next.
    void set_on(bool on);
    /// Of each stage, remembers only so many samples from now on, or up to twice as many.
    void keep_last(std::size_t samples) { kept_ = samples; }
    /// Another fluid is timed from now on.
    void forget();
    /// Stages in the order they first ran.
    const std::vector<std::string>& stages() const { return order_; }
    const Timings& of(const std::string& stage) const { return timings_.at(stage); }

    struct Moment {
        double cpu_ms, wall_ms;
    };
    /// Waits for the GPU, then reads both clocks.
    static Moment now();

  private:
    void hear(std::string_view stage, bool begins);

    gles::Gpu& gpu_;
    bool on_ = false;
    std::size_t kept_ = 0;  ///< 0: all
    std::vector<std::string> order_;
    std::map<std::string, Timings> timings_;
    std::vector<Moment> begun_;
    std::set<std::string> sampled_;  ///< stages that ran since it was turned on
};

}  // namespace eddy
