#pragma once
#include <functional>
#include <vector>

#include "config/scene.h"
#include "gles/gpu.h"

namespace eddy::stability {

/// What a show has come to after some steps. Means are over the steps since the sample before.
struct LongRunSample {
    long steps = 0;
    double pressure_mean_pa = 0.0;   ///< over the tank, now
    double pressure_scale_pa = 0.0;  ///< rho (L / dt)^2: of a flow that crosses the tank in a step
    double smoke_total_m3 = 0.0;     ///< now
    double kinetic_energy_j = 0.0;   ///< now
    double force_mean_n = 0.0;       ///< of |force on the held body by the fluid|
    double sent_mean_n = 0.0;        ///< of |force that reached the hand|
    double memory_mib = 0.0;         ///< resident, of the whole program
    double texture_mib = 0.0;
    std::size_t textures_made = 0;  ///< since the start of the program
    std::size_t programs = 0, framebuffers = 0;
};

enum class Visitor { None, Stirs };

/// Runs a scene as the exhibit does, with the haptic loop on a stepped clock, for so many steps. A visitor repeats what he does
/// every two minutes (PersonMotion): there is a sample after each, the first after the second. `on_step`, which may
/// be empty, hears how far it is.
std::vector<LongRunSample> long_run(gles::Gpu& gpu, const Scene& scene, Visitor visitor, long steps,
                                    const std::function<void(long step)>& on_step = {});

/// What has drifted between the first sample and the last, in words, one for each thing; empty: all is flat.
std::vector<std::string> drifts(const std::vector<LongRunSample>& samples);

}  // namespace eddy::stability
