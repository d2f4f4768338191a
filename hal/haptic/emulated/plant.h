#pragma once
#include <memory>

#include "hal/haptic/emulated/hand_motion.h"
#include "hal/haptic/falcon/kinematics.h"

namespace eddy::emulated {

enum class Hand {
    OnPath,  ///< the hand is stronger than any motor: the handle is where the motion says, as far as the
             ///< stops allow
    None,    ///< nobody holds it
    Arm,  ///< an arm holds the handle and is pulled towards the motion by a spring and a damper; it feels the
          ///< motors
};

struct PlantSettings {
    Hand hand = Hand::Arm;
    // The Falcon: from one student's measurement,
    // ZhuoxuanCao/Novint-Falcon-Haptic-Feedback-and-3D-Simulation, Report.pdf.
    double handle_mass_kg = 0.459;
    double handle_damping_ns_m = 2.8;
    double handle_friction_n = 0.0;  ///< dry: the same at every speed
    // A person's arm: one measured trial in van Beek et al. 2015, Scientific Reports 5:18004.
    double arm_mass_kg = 0.554;
    double arm_damping_ns_m = 6.45;
    double arm_stiffness_n_m = 135.0;
};

/// The handle: a mass with damping between stops, moved by the motors and by a hand. All in the Device frame.
class Plant {
  public:
    Plant(std::unique_ptr<HandMotion> motion, const PlantSettings& settings);

    /// Hangs so much on the handle, in place of what hung there: more to move, and its weight pulls down.
    void hang(double mass_kg) { hung_kg_ = mass_kg; }
    /// From now on nobody holds it.
    void let_go() { settings_.hand = Hand::None; }
    /// From now on it is held so.
    void hold(Hand hand) { settings_.hand = hand; }

    /// Puts the handle, at rest, where the hand wants to be at this time.
    void start(Instant at);
    /// Moves on to this time under a constant motor force [N]. Does nothing if the time has passed.
    void advance(Instant to, const glm::dvec3& force_n);

    glm::dvec3 position_m() const { return position_; }
    glm::dvec3 velocity_m_s() const { return velocity_; }
    /// Joint angles; the handle never leaves where they exist.
    const falcon::Legs& legs() const { return legs_; }

  private:
    void follow(Instant to);
    void step(double dt, const glm::dvec3& force_n);
    void place(const glm::dvec3& wanted);

    std::unique_ptr<HandMotion> motion_;
    PlantSettings settings_;
    double hung_kg_ = 0.0;
    Instant time_{0};
    glm::dvec3 position_{0.0};  // [m]
    glm::dvec3 velocity_{0.0};  // [m/s]
    falcon::Legs legs_;
};

}  // namespace eddy::emulated
