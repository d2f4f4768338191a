#include "firmware/stability/random_scene.h"

#include <fmt/format.h>

#include "firmware/stability/draw.h"

namespace eddy::stability {
namespace {

/// Components within +-most, as a scene file has them.
std::string vector(Draw& draw, double most) {
    const glm::dvec3 v = draw.vector(most);
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

constexpr int kCells = 16;

/// What the parts of a scene are measured by.
struct Scales {
    double size_m;  ///< of the tank
    double dt_s;
    double speed_m_s;  ///< at which things cross the tank in 0.1 to 100 s
};

std::string walls(Draw& draw, const Scales& s) {
    std::string out = "[tank.walls]\n";
    // An inflow needs a way out somewhere; most tanks are closed.
    const double open = draw.chance(0.4) ? 0.3 : 0.0;
    const char* const sides[] = {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"};
    for (int i = 0; i < 6; ++i) {
        if (draw.chance(open)) {
            out += fmt::format("{} = \"open\"\n", sides[i]);
        } else if (draw.chance(open)) {
            double velocity[3] = {0.0, 0.0, 0.0};
            velocity[i / 2] = (i % 2 == 0 ? 1.0 : -1.0) * s.speed_m_s;
            out += fmt::format("{} = {{ kind = \"inflow\", velocity_m_s = [{}, {}, {}] }}\n", sides[i],
                               velocity[0], velocity[1], velocity[2]);
        } else {
            out += fmt::format("{} = \"{}\"\n", sides[i], draw.one_of({"slip", "no_slip"}));
        }
    }
    return out;
}

std::string shape(Draw& draw, const Scales& s) {
    const auto length = [&] { return draw.scale(0.01, 0.4) * s.size_m; };  // from a sixth of a cell on
    switch (draw.whole(0, 8)) {
        case 0:
            return fmt::format("shape = \"sphere\"\nradius_m = {}\n", length());
        case 1:
            return fmt::format("shape = \"box\"\nsize_m = [{}, {}, {}]\n", length(), length(), length());
        case 2:
            return fmt::format("shape = \"capsule\"\nradius_m = {}\nlength_m = {}\n", length(), length());
        case 3:
            return fmt::format("shape = \"cylinder\"\nradius_m = {}\nlength_m = {}\n", length(), length());
        case 4: {
            const double radius_m = length();
            return fmt::format("shape = \"torus\"\nradius_m = {}\ntube_radius_m = {}\n", radius_m,
                               draw.between(0.1, 0.9) * radius_m);
        }
        case 5:
            return fmt::format("shape = \"ellipsoid\"\nradii_m = [{}, {}, {}]\n", length(), length(),
                               length());
        case 6:
            return fmt::format("shape = \"disk\"\nradius_m = {}\nthickness_m = {}\n", length(), length());
        case 7:
            return fmt::format(
                "shape = \"paddle\"\nblade_m = [{}, {}, {}]\nhandle_radius_m = {}\nhandle_length_m = {}\n",
                length(), length(), length(), length(), length());
        default:
            return fmt::format("shape = \"tetrahedron\"\nedge_m = {}\n", length());
    }
}

std::string body(Draw& draw, const Scales& s, double density_kg_m3) {
    const auto place = [&] { return draw.between(-0.1, 1.1) * s.size_m; };
    std::string out = "[[body]]\n" + shape(draw, s);
    out += fmt::format("centre_m = [{}, {}, {}]\naxis = {}\nangle_deg = {}\n", place(), place(), place(),
                       vector(draw, 1.0), draw.between(-180.0, 180.0));
    const std::string motion = draw.one_of({"fixed", "prescribed", "prescribed", "free"});
    out += fmt::format("motion = \"{}\"\n", motion);
    if (motion == "free")
        out += fmt::format("density_kg_m3 = {}\n", std::min(1e5, draw.scale(0.01, 100.0) * density_kg_m3));
    if (motion != "prescribed") return out;
    if (draw.chance(0.5)) out += fmt::format("velocity_m_s = {}\n", vector(draw, s.speed_m_s));
    const bool spins = draw.chance(0.3);
    if (spins) out += fmt::format("spin_rad_s = {}\n", vector(draw, draw.scale(0.1, 1.0) / s.dt_s));
    // Up to half a swing a step: the fastest that is still a swing.
    if (draw.chance(0.5))
        out += fmt::format("oscillation = {{ amplitude_m = {}, frequency_hz = {}, angle_deg = {} }}\n",
                           vector(draw, draw.scale(0.001, 0.3) * s.size_m),
                           std::min(1e4, draw.scale(0.001, 0.5) / s.dt_s),
                           spins ? 0.0 : draw.between(0.0, 90.0));
    return out;
}

std::string source(Draw& draw, const Scales& s, bool smoke, bool heat) {
    const auto place = [&] { return draw.between(0.0, 1.0) * s.size_m; };
    std::string out = fmt::format("[[source]]\ncentre_m = [{}, {}, {}]\nradius_m = {}\n", place(), place(),
                                  place(), draw.scale(0.05, 0.4) * s.size_m);
    if (smoke) out += fmt::format("smoke_per_s = {}\n", draw.scale(0.01, 100.0));
    if (heat)
        out += fmt::format("temperature_k_per_s = {}\n", draw.between(-1.0, 1.0) * draw.scale(0.1, 1000.0));
    if (draw.chance(0.6) || !(smoke || heat))
        out += fmt::format("velocity_m_s = {}\n", vector(draw, s.speed_m_s));
    if (draw.chance(0.3)) out += fmt::format("stop_s = {}\n", draw.between(1.0, 200.0) * s.dt_s);
    return out;
}

std::string solver(Draw& draw, const Scales& s) {
    const std::string preset = draw.one_of({"fast", "fast", "precise", "precise", "yang2009"});
    std::string out = fmt::format("[solver]\npreset = \"{}\"\ndt_s = {}\n", preset, s.dt_s);
    if (preset == "yang2009") return out;
    if (draw.chance(0.3)) out += fmt::format("cycles = {}\n", draw.whole(1, 4));
    if (draw.chance(0.3))
        out += fmt::format("advection = \"{}\"\n", draw.one_of({"semi_lagrangian", "maccormack"}));
    if (draw.chance(0.1)) out += "time_order = 2\n";
    return out;
}

/// Not every text is a scene: rules say what goes with what.
std::string random_text(Draw& draw) {
    Scales s{draw.scale(0.01, 10.0), draw.scale(1e-3, 0.1), 0.0};
    s.speed_m_s = s.size_m * draw.scale(0.01, 10.0);
    const double density_kg_m3 = draw.scale(0.1, 1e4), h_m = s.size_m / kCells;
    std::string out =
        fmt::format("[tank]\nsize_m = [{0}, {0}, {0}]\ncells = [{1}, {1}, {1}]\n", s.size_m, kCells);
    out += walls(draw, s);
    out += fmt::format("[fluid]\ndensity_kg_m3 = {}\n", density_kg_m3);
    const bool heavy = draw.chance(0.6);
    if (heavy)
        out += draw.chance(0.7) ? "gravity_m_s2 = [0.0, -9.81, 0.0]\n"
                                : fmt::format("gravity_m_s2 = {}\n", vector(draw, 20.0));
    // nu dt / h^2 from 1e-4 to 1e3.
    if (draw.chance(0.6))
        out += fmt::format("viscosity_pa_s = {}\n",
                           std::min(1e5, density_kg_m3 * draw.scale(1e-4, 1e3) * h_m * h_m / s.dt_s));
    const bool smoke = draw.chance(0.6), heat = draw.chance(0.3);
    if (smoke) {
        out +=
            fmt::format("[smoke]\ndissipation_1_s = {}\n", draw.chance(0.5) ? 0.0 : draw.scale(0.01, 100.0));
        if (heavy && draw.chance(0.5))
            out += fmt::format("weight = {}\n", draw.between(-1.0, 1.0) * draw.scale(0.01, 10.0));
        if (draw.chance(0.5))
            out += fmt::format("initial = \"exp(-((y - {}) / {})^2)\"\n", 0.5 * s.size_m, 0.1 * s.size_m);
    }
    if (heat) {
        out +=
            fmt::format("[temperature]\ndiffusivity_m2_s = {}\n",
                        draw.chance(0.5) ? 0.0 : std::min(1e3, draw.scale(1e-4, 1e3) * h_m * h_m / s.dt_s));
        if (heavy) out += fmt::format("expansion_1_k = {}\n", draw.scale(1e-5, 0.1));
        if (draw.chance(0.5))
            out += fmt::format("initial_k = \"{} * x\"\n", draw.between(-20.0, 20.0) / s.size_m);
    }
    if (draw.chance(0.2))
        out += fmt::format("[vorticity_confinement]\nstrength_1_s = {}\n",
                           std::min(1e3, draw.scale(0.01, 10.0) / s.dt_s));
    if (draw.chance(0.3))
        out += fmt::format(
            "[initial]\nvelocity_m_s = [\"{0} * sin(x * {1}) * cos(y * {1})\", \"-{0} * cos(x * {1}) * sin(y "
            "* {1})\", 0.0]\n",
            s.speed_m_s, 3.141592653589793 * draw.whole(1, 4) / s.size_m);
    if (draw.chance(0.2))
        out += fmt::format("[forcing]\nacceleration_m_s2 = [\"{} * (1 + sin(t)) * (z - {})\", 0.0, 0.0]\n",
                           s.speed_m_s / s.size_m, 0.5 * s.size_m);
    for (int n = draw.whole(0, 2); n > 0; --n)
        out += source(draw, s, smoke && draw.chance(0.7), heat && draw.chance(0.7));
    for (int n = draw.whole(0, 3); n > 0; --n) out += body(draw, s, density_kg_m3);
    return out + solver(draw, s);
}

/// The scene as a file would give it back, unless no file may say so.
std::optional<Scene> as_from_a_file(const std::string& text) {
    try {
        return read_scene(text, "random.toml").scene;
    } catch (const ConfigError&) {
        return std::nullopt;
    }
}

}  // namespace

Scene random_scene(std::uint64_t seed) {
    Draw draw(seed);
    while (true)
        if (const auto scene = as_from_a_file(random_text(draw))) {
            Scene named = *scene;
            named.title = fmt::format("Random scene {}", seed);
            return named;
        }
}

std::vector<Scene> simpler_scenes(const Scene& scene) {
    std::vector<Scene> simpler;
    const auto without = [&](const std::function<void(Scene&)>& take_out) {
        Scene less = scene;
        take_out(less);
        if (less == scene) return;
        if (const auto read = as_from_a_file(print_scene(less))) simpler.push_back(*read);
    };
    const auto index = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        without([&](Scene& s) { s.bodies.erase(s.bodies.begin() + index(i)); });
    for (std::size_t i = 0; i < scene.sources.size(); ++i)
        without([&](Scene& s) { s.sources.erase(s.sources.begin() + index(i)); });
    const auto lose = [](auto member) { return [member](Scene& s) { (s.*member).reset(); }; };
    without([](Scene& s) {  // sources may feed it
        s.smoke.reset();
        for (Scene::Source& source : s.sources) source.smoke_per_s.reset();
    });
    without([](Scene& s) {
        s.temperature.reset();
        for (Scene::Source& source : s.sources) source.temperature_k_per_s.reset();
    });
    without(lose(&Scene::vorticity_confinement));
    without(lose(&Scene::forcing));
    without([](Scene& s) { s.initial = {}; });
    without([](Scene& s) { s.fluid.viscosity_pa_s = 0.0; });
    without([](Scene& s) {
        s.fluid.gravity_m_s2 = glm::dvec3(0.0);
        if (s.smoke) s.smoke->weight = 0.0;
        if (s.temperature) s.temperature->expansion_1_k = 0.0;
    });
    for (std::size_t i = 0; i < scene.tank.walls.all().size(); ++i)
        without([&](Scene& s) { *s.tank.walls.all()[i] = {}; });
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        without([&](Scene& s) { s.bodies[i].oscillation.reset(); });
        without([&](Scene& s) { s.bodies[i].spin_rad_s = glm::dvec3(0.0); });
        without([&](Scene& s) { s.bodies[i].velocity_m_s = glm::dvec3(0.0); });
        without([&](Scene& s) { s.bodies[i].angle_deg = 0.0; });
        without([&](Scene& s) {
            s.bodies[i].motion = BodyMotion::Fixed;
            s.bodies[i].density_kg_m3.reset();
            s.bodies[i].oscillation.reset();
            s.bodies[i].spin_rad_s = s.bodies[i].velocity_m_s = glm::dvec3(0.0);
        });
    }
    for (std::size_t i = 0; i < scene.sources.size(); ++i) {
        without([&](Scene& s) { s.sources[i].velocity_m_s.reset(); });
        without([&](Scene& s) { s.sources[i].stop_s.reset(); });
    }
    without([](Scene& s) {
        const double dt_s = s.solver.dt_s;
        s.solver = {};
        s.solver.dt_s = dt_s;
    });
    return simpler;
}

Scene shrink(Scene scene, const std::function<bool(const Scene&)>& fails) {
    for (bool spared = true; spared;) {
        spared = false;
        for (const Scene& less : simpler_scenes(scene)) {
            if (!fails(less)) continue;
            scene = less;
            spared = true;
            break;
        }
    }
    return scene;
}

}  // namespace eddy::stability
