#pragma once
#include "gles/fluid/fluid.h"
#include "gles/gpu.h"

namespace eddy::stability {

/// Looks at the velocity between its transport and the projection, where no field of the fluid shows it. Cut cells only.
class TransportWatch {
  public:
    explicit TransportWatch(gles::Gpu& gpu);
    ~TransportWatch();
    TransportWatch(const TransportWatch&) = delete;
    TransportWatch& operator=(const TransportWatch&) = delete;

    /// A step is about to be taken that is worth a look, which costs as much as a step.
    void begin_step(const gles::Fluid& fluid);
    /// How far a component of the velocity has gone beyond its extremes before the step and the velocities of jets [m/s];
    /// 0 if it has not.
    double overshoot_m_s() const;

  private:
    struct Range {
        glm::vec3 low{0.0f}, high{0.0f};
        void add(const glm::vec3& v) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
    };
    void see(std::string_view stage, bool begins);

    gles::Gpu& gpu_;
    glm::ivec3 cells_{0};
    bool watching_ = false;  ///< the step that was announced
    std::vector<gles::PassRecord> passes_;
    Range before_, after_;
};

}  // namespace eddy::stability
