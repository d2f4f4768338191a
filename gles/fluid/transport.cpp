#include "gles/fluid/transport.h"

#include <fmt/format.h>

#include <cmath>

#include "gles/fluid/step_guard.h"

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
    Variant variant{.layouts = {{"FACES", faces}}, .defines = {farthest(setup)}};
    if (setup.solver.time_order == 2) variant.defines.emplace_back("CARRIER", "");
    walls.declare(variant);
    const bool corrects = setup.solver.advection == Advection::MacCormack;
    forward_.emplace(gpu, "advect velocity",
                     corrects ? "gles/fluid/advect_faces.frag" : "gles/fluid/advect_velocity.frag", faces,
                     variant);
    if (corrects)
        correct_.emplace(gpu, "correct velocity", "gles/fluid/maccormack_velocity.frag", faces, variant);
}

Field<Faces> VelocityTransport::operator()(const Field<Faces>& u, const Field<Faces>& carrier, double dt_s,
                                           const Uniform& wall_time) {
    const std::vector<Uniform> uniforms{{"dt_h", static_cast<float>(dt_s / cell_m_)}, wall_time};
    Field<Faces> forward(*gpu_, u.cells(), Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}, {"carrier", &carrier.texture()}};
    forward_->draw(inputs, uniforms, {&forward.texture()});
    if (!correct_) return forward;
    Field<Faces> corrected(*gpu_, u.cells(), Format::RGBA32F);
    inputs.push_back({"forward", &forward.texture()});
    correct_->draw(inputs, uniforms, {&corrected.texture()});
    return corrected;
}

ScalarTransport::ScalarTransport(Gpu& gpu, const FluidSetup& setup, const ScalarSetup& scalar,
                                 const Walls& walls)
    : gpu_(&gpu), cell_m_(setup.cell_m), scalar_(scalar) {
    const AtlasLayout cells = Cells::layout(setup.cells);
    Variant variant{.layouts = {{"FACES", Faces::layout(setup.cells)}}, .defines = {farthest(setup)}};
    walls.declare(variant);
    Variant last = variant;
    if (scalar.fading_1_s > 0.0) last.defines.emplace_back("FADES", "");
    const std::string name = scalar.name;
    const bool corrects = setup.solver.advection == Advection::MacCormack;
    const char* last_shader =
        corrects ? "gles/fluid/maccormack_scalar.frag" : "gles/fluid/advect_scalar.frag";
    forward_.emplace(gpu, "advect " + name, "gles/fluid/advect_scalar.frag", cells,
                     corrects ? variant : last);
    if (corrects) correct_.emplace(gpu, "correct " + name, last_shader, cells, last);
    for (const SourceSetup& source : setup.sources) {
        if (source.*scalar.from_source == 0.0) continue;
        sources_.push_back(source);
        source_balls_.push_back(ball_cells(source, setup.cell_m));
        source_boxes_.push_back(ball_box(source_balls_.back(), setup.cells));
    }
    if (sources_.empty()) return;
    last.defines.emplace_back("SOURCES", fmt::format("{}", sources_.size()));
    with_sources_.emplace(gpu, name + " sources", last_shader, cells, last);
}

Field<Cells> ScalarTransport::operator()(const Field<Cells>& s, const Field<Faces>& u, double time_s,
                                         double dt_s, const Uniform& wall_time) {
    std::vector<Input> inputs{{"velocity", &u.texture()}, {"scalar", &s.texture()}};
    std::vector<Uniform> uniforms{{"dt_h", static_cast<float>(dt_s / cell_m_)},
                                  {"remains", static_cast<float>(std::exp(-scalar_.fading_1_s * dt_s))},
                                  wall_time};
    Field<Cells> next(*gpu_, s.cells(), Format::R32F);
    forward_->draw(inputs, uniforms, {&next.texture()});
    Field<Cells> forward;
    if (correct_) {
        forward = std::move(next);
        next = Field<Cells>(*gpu_, s.cells(), Format::R32F);
        inputs.push_back({"forward", &forward.texture()});
        correct_->draw(inputs, uniforms, {&next.texture()});
    }
    if (with_sources_) {
        std::vector<glm::vec3> gains;
        for (const SourceSetup& source : sources_)
            gains.emplace_back(is_running(source, time_s) ? dt_s * source.*scalar_.from_source : 0.0, 0.0,
                               0.0);
        uniforms.insert(uniforms.end(), {{"source_ball", source_balls_}, {"source_gain", gains}});
        with_sources_->draw(inputs, uniforms, {&next.texture()}, Region(source_boxes_));
    }
    return next;
}

}  // namespace eddy::gles
