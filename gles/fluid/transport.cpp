#include "gles/fluid/transport.h"

#include <fmt/format.h>

#include <cmath>

namespace eddy::gles {

bool is_running(const SourceSetup& source, double time_s) {
    return time_s >= source.start_s && time_s < source.stop_s;
}

glm::vec4 ball_cells(const SourceSetup& source, double cell_m) {
    return {glm::vec3(source.centre_m / cell_m), static_cast<float>(source.radius_m / cell_m)};
}

Box ball_box(const glm::vec4& ball, const glm::ivec3& limit) {
    const glm::vec3 centre(ball), reach(ball.w + 1.0f);
    return Box{glm::ivec3(glm::floor(centre - reach)), glm::ivec3(glm::ceil(centre + reach))}.intersect(
        {glm::ivec3(0), limit});
}

VelocityTransport::VelocityTransport(Gpu& gpu, const FluidSetup& setup, const Walls& walls)
    : gpu_(&gpu), cell_m_(setup.cell_m) {
    const AtlasLayout faces = Faces::layout(setup.cells);
    Variant variant{.layouts = {{"FACES", faces}}};
    walls.declare(variant);
    const bool corrects = setup.solver.advection == Advection::MacCormack;
    forward_.emplace(gpu, "advect velocity",
                     corrects ? "gles/fluid/advect_faces.frag" : "gles/fluid/advect_velocity.frag", faces,
                     variant);
    if (corrects)
        correct_.emplace(gpu, "correct velocity", "gles/fluid/maccormack_velocity.frag", faces, variant);
}

Field<Faces> VelocityTransport::operator()(const Field<Faces>& u, double dt_s, const Uniform& wall_time) {
    const std::vector<Uniform> uniforms{{"dt_h", static_cast<float>(dt_s / cell_m_)}, wall_time};
    Field<Faces> forward(*gpu_, u.cells(), Format::RGBA32F);
    forward_->draw({{"velocity", &u.texture()}}, uniforms, {&forward.texture()});
    if (!correct_) return forward;
    Field<Faces> corrected(*gpu_, u.cells(), Format::RGBA32F);
    correct_->draw({{"velocity", &u.texture()}, {"forward", &forward.texture()}}, uniforms,
                   {&corrected.texture()});
    return corrected;
}

SmokeTransport::SmokeTransport(Gpu& gpu, const FluidSetup& setup, const Walls& walls)
    : gpu_(&gpu), setup_(setup) {
    Variant variant{.layouts = {{"FACES", Faces::layout(setup.cells)}}};
    walls.declare(variant);
    forward_.emplace(gpu, "advect smoke", "gles/fluid/advect_smoke.frag", Cells::layout(setup.cells),
                     variant);
    const bool corrects = setup.solver.advection == Advection::MacCormack;
    const char* last_shader = corrects ? "gles/fluid/maccormack_smoke.frag" : "gles/fluid/advect_smoke.frag";
    if (corrects) correct_.emplace(gpu, "correct smoke", last_shader, Cells::layout(setup.cells), variant);
    for (const SourceSetup& source : setup.sources) {
        if (source.smoke_per_s <= 0.0) continue;
        source_balls_.push_back(ball_cells(source, setup.cell_m));
        source_boxes_.push_back(ball_box(source_balls_.back(), setup.cells));
    }
    if (source_balls_.empty()) return;
    variant.defines.emplace_back("SOURCES", fmt::format("{}", source_balls_.size()));
    with_sources_.emplace(gpu, "smoke sources", last_shader, Cells::layout(setup.cells), variant);
}

Field<Cells> SmokeTransport::operator()(const Field<Cells>& smoke, const Field<Faces>& u, double time_s,
                                        double dt_s, const Uniform& wall_time) {
    const Uniform dt_h{"dt_h", static_cast<float>(dt_s / setup_.cell_m)};
    Uniform remains{"remains", static_cast<float>(std::exp(-setup_.smoke->dissipation_1_s * dt_s))};
    std::vector<glm::vec3> gains;
    for (const SourceSetup& source : setup_.sources)
        if (source.smoke_per_s > 0.0)
            gains.emplace_back(is_running(source, time_s) ? dt_s * source.smoke_per_s : 0.0, 0.0, 0.0);

    Field<Cells> next(*gpu_, smoke.cells(), Format::R32F);
    if (!correct_) {
        const std::vector<Input> inputs{{"velocity", &u.texture()}, {"smoke", &smoke.texture()}};
        forward_->draw(inputs, {dt_h, remains, wall_time}, {&next.texture()});
        if (with_sources_)
            with_sources_->draw(
                inputs, {dt_h, remains, wall_time, {"source_ball", source_balls_}, {"source_gain", gains}},
                {&next.texture()}, Region(source_boxes_));
        return next;
    }
    Field<Cells> forward(*gpu_, smoke.cells(), Format::R32F);
    forward_->draw({{"velocity", &u.texture()}, {"smoke", &smoke.texture()}},
                   {dt_h, {"remains", 1.0f}, wall_time}, {&forward.texture()});
    const std::vector<Input> inputs{
        {"velocity", &u.texture()}, {"smoke", &smoke.texture()}, {"forward", &forward.texture()}};
    correct_->draw(inputs, {dt_h, remains, wall_time}, {&next.texture()});
    if (with_sources_)
        with_sources_->draw(
            inputs, {dt_h, remains, wall_time, {"source_ball", source_balls_}, {"source_gain", gains}},
            {&next.texture()}, Region(source_boxes_));
    return next;
}

}  // namespace eddy::gles
