#pragma once
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

namespace eddy {

/// Scenes that have between them every key there is, none at its default: with walls and effects, with the
/// method of 2009, and with an imposed flow. The files they name lie in `folder`.
inline std::array<std::string, 3> scenes_with_every_key(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const char* name : {"path.csv", "fish.stl", "u.npy"}) std::ofstream(folder / name) << "\n";
    const std::string at = folder.string();
    return {
        R"toml(
title = "All \"keys\""
description = "tab\tand\nline, é"
[tank]
size_m = [0.3, 0.2, 0.1]
cells = [30, 20, 10]
[tank.walls]
x_low = { kind = "inflow", velocity_m_s = ["0.1 * y * (0.2 - y)", 0, 0] }
x_high = "open"
y_low = "no_slip"
y_high = { kind = "no_slip", velocity_m_s = [0.1, 0, "sin(t)"] }
z_low = { kind = "no_slip" }
z_high = "open"
[fluid]
density_kg_m3 = 998.2
viscosity_pa_s = 0.001
gravity_m_s2 = [0, -9.81, 0]
[temperature]
expansion_1_k = 0.0002
diffusivity_m2_s = 1.4e-7
initial_k = "20 * (y < 0.1)"
[smoke]
dissipation_1_s = 0.1
weight = -0.5
initial = "exp(-((x - 0.1)^2 + y^2) / 0.01)"
[vorticity_confinement]
strength_1_s = 0.3
[[source]]
name = "wind"
centre_m = [0.1, 0.1, 0.05]
radius_m = 0.02
smoke_per_s = 3
temperature_k_per_s = -4
velocity_m_s = [1e-7, 0.1, 12345678.9]
start_s = 1
stop_s = 2.5
[[source]]
centre_m = [0.1, 0.1, 0.05]
radius_m = 0.02
smoke_per_s = 4
[[body]]
name = "ball"
shape = "sphere"
radius_m = 0.01
centre_m = [0.1, 0.1, 0.1]
motion = "prescribed"
velocity_m_s = [1, 2, 3]
acceleration_m_s2 = [4, 5, 6]
path_csv = ")toml" +
            at + R"toml(/path.csv"
start_s = 0.3333333333333333
force = false
torque = false
oscillation = { amplitude_m = [0.01, 0, 0], frequency_hz = 2, phase_rad = 1.5, axis = [1, 0, 0], angle_deg = 30 }
[[body]]
shape = "paddle"
blade_m = [0.02, 0.03, 0.003]
handle_radius_m = 0.002
handle_length_m = 0.03
motion = "held"
turning = true
[[body]]
shape = "torus"
radius_m = 0.02
tube_radius_m = 0.005
centre_m = [0.2, 0.1, 0.05]
axis = [1, 1, 0]
angle_deg = 45
motion = "free"
density_kg_m3 = 1100
[[body]]
shape = "capsule"
radius_m = 0.4
length_m = 0.1
inside_out = true
centre_m = [0.1, 0.1, 0.05]
[[body]]
shape = "mesh"
file = ")toml" +
            at + R"toml(/fish.stl"
scale = 0.001
centre_m = [0.1, 0.1, 0.05]
[forcing]
acceleration_m_s2 = ["sin(pi * x) * cos(2 * t)", 0, 1e-3]
[initial]
velocity_m_s = ["0.1 * sin(pi * x)", -0.1, 0.05]
[solver]
preset = "precise"
dt_s = 0.01
advection = "semi_lagrangian"
cycles = 4
viscous_cycles = 3
time_order = 2
[haptics]
gain = 1e5
max_force_n = 2
workspace_scale = 1.5
centre_m = [0.1, 0.12, 0.02]
[render]
width_px = 1920
height_px = 1080
azimuth_deg = -30
elevation_deg = 40
distance_factor = 2
smoke_colour = [1, 0.5, 0.25]
background_colour = [0, 0, 0]
exposure = 2
extinction_1_m = 100
[[probe]]
name = "wake"
quantity = "velocity"
point_m = [0.1, 0.1, 0.05]
[[probe]]
quantity = "temperature"
from_m = [0, 0.1, 0.05]
to_m = [0.3, 0.1, 0.05]
points = 31
[outputs]
duration_s = 3
force_methods = true
fields = ["velocity", "smoke", "temperature", "vorticity"]
)toml",
        R"toml(
[[body]]
shape = "box"
size_m = [0.01, 0.02, 0.03]
centre_m = [0.1, 0.1, 0.1]
motion = "prescribed"
spin_rad_s = [7, 8, 9]
[[body]]
shape = "cylinder"
radius_m = 0.01
length_m = 0.02
centre_m = [0.1, 0.1, 0.1]
[[body]]
shape = "disk"
radius_m = 0.01
thickness_m = 0.002
centre_m = [0.1, 0.1, 0.1]
[[body]]
shape = "ellipsoid"
radii_m = [0.01, 0.02, 0.03]
centre_m = [0.1, 0.1, 0.1]
[[body]]
shape = "tetrahedron"
edge_m = 0.02
centre_m = [0.1, 0.1, 0.1]
[initial]
velocity_npy = ")toml" +
            at + R"toml(/u.npy"
[solver]
preset = "yang2009"
jacobi_sweeps = 60
force_sum = "cpu"
[outputs]
series = false
)toml",
        R"toml(
[smoke]
initial = "x < 0.08 ? 1 : 0"
[imposed]
velocity_m_s = ["-y", "x", 0]
)toml"};
}

}  // namespace eddy
