#include "gles/body/grip.h"

#include <fmt/format.h>

#include <cmath>

namespace eddy::gles {

Grip::Grip(Gpu& gpu, const std::vector<glm::ivec3>& grids, const std::vector<BodySetup>& bodies)
    : grids_(grids), surface_(gpu, grids[0], Format::RGBA32F), boxes_(grids.size()) {
    for (std::size_t l = 0; l < grids.size(); ++l) {
        const glm::ivec3& n = grids[l];
        levels_.push_back({{gpu, n, Format::RGBA32F}, {gpu, n, Format::RGBA32F}, {gpu, n, Format::RGBA32F}});
        Variant distances{.layouts = {{"FRACTION", Faces4::layout(n)}},
                          .defines = {{"SCALE", fmt::format("{:.1f}", std::exp2(static_cast<double>(l)))}},
                          .declarations = shape_declarations(bodies)};
        Variant grips{.layouts = {{"FACES", Faces::layout(n)}}};
        if (l == 0) {
            grips.declarations = distances.declarations;
        } else {
            distances.defines.emplace_back("COARSE", "");
            grips.defines.emplace_back("COARSE", "");
        }
        draw_distances_.emplace_back(gpu, fmt::format("distances {}", l), "gles/body/distances.frag",
                                     Faces::layout(n), distances);
        draw_grips_.emplace_back(gpu, fmt::format("grip {}", l), "gles/body/grip.frag", Faces::layout(n),
                                 grips);
    }
}

void Grip::update(const BodyUniforms& bodies, const std::vector<Box>& boxes, const FaceFractions& fractions) {
    std::vector<Box> here = boxes, before = before_;
    std::vector<Input> inputs = fractions.inputs();
    inputs.insert(inputs.end(), bodies.inputs().begin(), bodies.inputs().end());
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const Level& level = levels_[l];
        boxes_[l].clear();
        for (const Box& box : here) boxes_[l].push_back(box.faces());
        std::vector<Box> touched = boxes_[l];
        for (const Box& box : before) touched.push_back(box.faces());
        // Grips look one face further.
        std::vector<Box> looked_at = touched;
        for (Box& box : looked_at) box = box.grow(1);
        draw_distances_[l].draw(inputs, bodies.uniforms(),
                                {&level.distances.texture(), &level.shares.texture()},
                                drawn_ ? Region(looked_at) : Region::everything());
        std::vector<Input> of_grip = bodies.inputs();
        of_grip.insert(of_grip.end(),
                       {{"distances", &level.distances.texture()}, {"shares", &level.shares.texture()}});
        std::vector<const Texture*> outputs{&level.grips.texture()};
        if (l == 0) outputs.push_back(&surface_.texture());
        draw_grips_[l].draw(of_grip, bodies.uniforms(), outputs,
                            drawn_ ? Region(touched) : Region::everything());
        const Box tank{glm::ivec3(0), grids_[l]};
        for (Box& box : here) box = box.coarsen().grow(1).intersect(tank);
        for (Box& box : before) box = box.coarsen().grow(1).intersect(tank);
    }
    before_ = boxes;
    drawn_ = true;
}

}  // namespace eddy::gles
