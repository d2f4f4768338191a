#include "gles/body/fractions.h"

#include <fmt/format.h>

namespace eddy::gles {
namespace {

/// A face belongs to the two cells at its sides: a box of cells touches one layer of faces more at its upper
/// side.
Box faces_of(const Box& cells) {
    return {cells.lo, cells.hi + 1};
}

}  // namespace

Fractions::Fractions(Gpu& gpu, const std::vector<glm::ivec3>& grids, const std::vector<BodySetup>& bodies)
    : grids_(grids),
      finest_(gpu, "fractions", "gles/body/fractions.frag", Faces4::layout(grids[0]),
              {.declarations = shape_declarations(bodies)}) {
    for (const glm::ivec3& n : grids)
        levels_.push_back({{gpu, n, Format::RGBA32F}, {gpu, n, Format::RGBA32F}, {gpu, n, Format::RGBA32F}});
    for (std::size_t l = 0; l + 1 < grids.size(); ++l)
        coarsen_.emplace_back(gpu, fmt::format("coarsen fractions {}", l + 1),
                              "gles/body/coarsen_fractions.frag", Faces4::layout(grids[l + 1]),
                              Variant{.layouts = {{"FINE", Faces4::layout(grids[l])}},
                                      .defines = {{"FINE_LAYERS", fmt::format("{}", grids[l].z + 1)},
                                                  {"FINE_CELLS", glsl(grids[l])}}});
}

void Fractions::update(const BodyUniforms& bodies, const std::vector<Box>& boxes) {
    if (!drawn_) {
        draw(bodies, Region::everything(), std::vector<Region>(coarsen_.size(), Region::everything()));
        drawn_ = true;
        before_ = boxes;
        return;
    }
    std::vector<Box> touched = boxes;
    touched.insert(touched.end(), before_.begin(), before_.end());
    before_ = boxes;

    std::vector<Box> cells = touched;
    for (Box& box : touched) box = faces_of(box);
    std::vector<Region> coarse;
    for (std::size_t l = 0; l < coarsen_.size(); ++l) {
        std::vector<Box> faces;
        for (Box& box : cells) faces.push_back(faces_of(box = box.coarsen()));
        coarse.push_back(Region::packed(faces));
    }
    draw(bodies, Region::packed(touched), coarse);
}

void Fractions::draw(const BodyUniforms& bodies, const Region& finest, const std::vector<Region>& coarse) {
    const FaceFractions& a = levels_[0];
    finest_.draw({}, {bodies.centre(), bodies.size()}, {&a.x.texture(), &a.y.texture(), &a.z.texture()},
                 finest);
    for (std::size_t l = 0; l < coarsen_.size(); ++l) {
        const FaceFractions& fine = levels_[l];
        const FaceFractions& c = levels_[l + 1];
        coarsen_[l].draw({{"ax", &fine.x.texture()}, {"ay", &fine.y.texture()}, {"az", &fine.z.texture()}},
                         {}, {&c.x.texture(), &c.y.texture(), &c.z.texture()}, coarse[l]);
    }
}

}  // namespace eddy::gles
