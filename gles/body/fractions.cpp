#include "gles/body/fractions.h"

#include <fmt/format.h>

#include <algorithm>

#include "gles/body/bounds.h"
#include "gles/body/distance_grid.h"
#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

FaceFractions new_fractions(Gpu& gpu, const glm::ivec3& n) {
    return {{gpu, n, Format::RGBA32F}, {gpu, n, Format::RGBA32F}, {gpu, n, Format::RGBA32F}};
}

std::vector<const Texture*> outputs(const FaceFractions& a) {
    return {&a.x.texture(), &a.y.texture(), &a.z.texture()};
}

bool has_edges(const BodySetup& body) {
    return std::visit(
        []<class S>(const S&) {
            return !(std::is_same_v<S, Sphere> || std::is_same_v<S, Ellipsoid> ||
                     std::is_same_v<S, Capsule> || std::is_same_v<S, Torus>);
        },
        body.shape);
}

/// Parts an axis that a staggered cell is cut into: surfaces with edges need more than one plane.
int subcubes(const std::vector<BodySetup>& bodies) {
    return std::any_of(bodies.begin(), bodies.end(), has_edges) ? 2 : 1;
}

/// The thinnest solid that closes a layer of faces wherever it lies: the cells that its two surfaces touch, and one more.
constexpr double kThinCells = 2.7;

/// Twice as deep as a point inside can lie: where the body is thickest.
double thickest_m(const Shape& shape) {
    const Mesh* mesh = std::get_if<Mesh>(&shape);
    return mesh ? 2.0 * mesh->distance->depth_m() : thickness_m(shape);
}

/// Whether a body is thinner than that, by one thickness or the other. Of a mesh nobody knows where it is thinnest
/// (thickness_m() is 0). So the shaders look for thin places in every mesh, which costs little; but the pressure takes its
/// dearer cycles only beside one that is thin even where it is thickest.
bool any_thinner(const std::vector<BodySetup>& bodies, double cell_m, double (*width_m)(const Shape&)) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const BodySetup& body) {
        return !body.inside_out && width_m(body.shape) < kThinCells * cell_m;
    });
}

Variant finest_variant(const std::vector<BodySetup>& bodies, double cell_m) {
    Variant v{.defines = {{"SUBCUBES", fmt::format("{}", subcubes(bodies))}},
              .declarations = shape_declarations(bodies)};
    if (any_thinner(bodies, cell_m, thickness_m)) v.defines.emplace_back("THIN", "");
    return v;
}

Variant coarse_variant(const glm::ivec3& fine, const std::vector<BodySetup>& bodies, double cell_m) {
    Variant v{.layouts = {{"FINE", Faces4::layout(fine)}},
              .defines = {{"FINE_LAYERS", fmt::format("{}", fine.z + 1)}, {"FINE_CELLS", glsl(fine)}}};
    if (any_thinner(bodies, cell_m, thickness_m)) v.defines.emplace_back("THIN", "");
    return v;
}

bool is_boxed(const glm::ivec3& grid) {
    return std::min({grid.x, grid.y, grid.z}) >= kBoxedFrom;
}

}  // namespace

bool any_thin_body(const std::vector<BodySetup>& bodies, double cell_m) {
    return any_thinner(bodies, cell_m, thickest_m);
}

std::vector<Input> FaceFractions::inputs() const {
    return {{"ax", &x.texture()}, {"ay", &y.texture()}, {"az", &z.texture()}};
}

std::vector<glm::vec3> FaceFractions::download() const {
    const auto read = [](const Field<Faces4>& a) {
        return unpack_four(a.texture().download(), a.layout(), a.cells() + 1);
    };
    const std::vector<float> ax = read(x), ay = read(y), az = read(z);
    std::vector<glm::vec3> shares;
    for (std::size_t i = 0; i < ax.size(); ++i) shares.emplace_back(ax[i], ay[i], az[i]);
    return shares;
}

Fractions::Fractions(Gpu& gpu, const std::vector<glm::ivec3>& grids, const std::vector<BodySetup>& bodies,
                     double cell_m)
    : grids_(grids),
      volumes_(new_fractions(gpu, grids[0])),
      finest_(gpu, "fractions", "gles/body/fractions.frag", Faces4::layout(grids[0]),
              finest_variant(bodies, cell_m)),
      sharpen_(gpu, "sharpen fractions", "gles/body/sharpen_fractions.frag", Faces4::layout(grids[0]),
               {.defines = {{"CELLS", glsl(grids[0])}}}),
      are_thin_(any_thin_body(bodies, cell_m)) {
    for (const glm::ivec3& n : grids) levels_.push_back(new_fractions(gpu, n));
    for (std::size_t l = 0; l + 1 < grids.size(); ++l)
        coarsen_.emplace_back(gpu, fmt::format("coarsen fractions {}", l + 1),
                              "gles/body/coarsen_fractions.frag", Faces4::layout(grids[l + 1]),
                              coarse_variant(grids[l], bodies, cell_m));
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
    for (Box& box : touched) box = box.faces();
    std::vector<Region> coarse;
    for (std::size_t l = 0; l < coarsen_.size(); ++l) {
        std::vector<Box> faces;
        // As far as the pressure's sweeps of that grid look.
        for (Box& box : cells) faces.push_back((box = box.coarsen().grow(1)).faces());
        // A grid that is swept as a whole is drawn as a whole.
        coarse.push_back(is_boxed(grids_[l + 1]) ? Region::packed(faces) : Region::everything());
    }
    draw(bodies, is_boxed(grids_[0]) ? Region::packed(touched) : Region::everything(), coarse);
}

void Fractions::draw(const BodyUniforms& bodies, const Region& finest, const std::vector<Region>& coarse) {
    finest_.draw(bodies.inputs(), bodies.uniforms(), outputs(volumes_), finest);
    sharpen_.draw(volumes_.inputs(), {}, outputs(levels_[0]), finest);
    for (std::size_t l = 0; l < coarsen_.size(); ++l)
        coarsen_[l].draw(levels_[l].inputs(), {}, outputs(levels_[l + 1]), coarse[l]);
}

}  // namespace eddy::gles
