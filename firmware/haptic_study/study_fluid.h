#pragma once
#include "config/scene.h"
#include "firmware/haptic/exchange.h"
#include "firmware/haptic/hand_path.h"
#include "firmware/show.h"

namespace eddy::haptic_study {

/// A fluid as the haptic loop knows one: it takes the newest pose, works for a while, and answers.
class StudyFluid {
  public:
    virtual ~StudyFluid() = default;
    /// A step of dt that ends at `now`.
    virtual void update(Instant now, Seconds dt) = 0;
    /// The answer to the last step reaches the loop.
    virtual void publish() = 0;
    virtual HapticOrders orders() const = 0;

    HapticExchange exchange;
};

/// A drag and an added mass, exactly: known at the handle, after gain. It answers as a fluid of implicit steps does, whose body
/// goes evenly from pose to pose.
class KnownFluid final : public StudyFluid {
  public:
    struct Settings {
        double drag_ns_m = 3.0;
        double added_kg = 0.05;
        glm::dvec3 push_n{0.0};  ///< a steady jet
    };
    explicit KnownFluid(const Settings& settings) : settings_(settings) {}

    void update(Instant now, Seconds dt) override;
    void publish() override;
    HapticOrders orders() const override;

  private:
    Settings settings_;
    FluidSnapshot under_way_{}, done_{};
    HandPath path_;
    bool placed_ = false;
    glm::dvec3 position_m_{0.0}, velocity_m_s_{0.0};
};

/// The show of a scene, at its start; its gain as far as eddy run would let it have it if its fluid, which answers so steeply,
/// answered once in a period.
class SceneFluid final : public StudyFluid {
  public:
    SceneFluid(gles::Gpu& gpu, const Scene& scene, const FluidSlopes& slopes, Seconds period);

    void update(Instant now, Seconds dt) override;
    void publish() override { show_.publish(true); }
    HapticOrders orders() const override { return orders_; }

  private:
    Show show_;
    long updates_ = 0;
    HapticOrders orders_;
};

}  // namespace eddy::haptic_study
