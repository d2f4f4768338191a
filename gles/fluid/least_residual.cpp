#include "gles/fluid/least_residual.h"

namespace eddy::gles {

LeastResidual::Passes LeastResidual::make(bool first) const {
    const AtlasLayout phi = Cells4::layout(cells_);
    Variant variant{.layouts = {{"PHI", phi}}};
    if (first) variant.defines.emplace_back("FIRST", "");
    return {Pass(*gpu_, "residual products", "gles/fluid/residual_products.frag",
                 AtlasLayout{{cells_.x, cells_.y, 1}, 1}, variant),
            Pass(*gpu_, "least residual", "gles/fluid/least_residual.frag", phi, variant)};
}

LeastResidual::LeastResidual(Gpu& gpu, const glm::ivec3& cells)
    : gpu_(&gpu),
      cells_(cells),
      products_(gpu.textures().lease({1, 1}, Format::RGBA32F)),
      first_(make(true)),
      next_(make(false)),
      sum_(gpu, "reduce products", glm::ivec2(cells), {1, 1}) {}

void LeastResidual::restart() {
    p_ = {};
    q_ = {};
}

void LeastResidual::correct(Field<Cells4>& phi, Field<Cells4>& r, const Field<Cells4>& z,
                            const Field<Cells4>& r_z) {
    Passes& passes = p_ ? next_ : first_;
    std::vector<Input> inputs{{"r", &r.texture()}, {"r_z", &r_z.texture()}};
    if (p_) inputs.push_back({"q_last", &q_.texture()});
    {
        const TexturePool::Lease columns = gpu_->textures().lease(glm::ivec2(cells_), Format::RGBA32F);
        passes.products.draw(inputs, {}, {&*columns});
        sum_.draw(*columns, *products_, {0, 0});
    }
    inputs.insert(inputs.end(), {{"products", &*products_}, {"phi", &phi.texture()}, {"z", &z.texture()}});
    if (p_) inputs.push_back({"p_last", &p_.texture()});
    Field<Cells4> new_phi(*gpu_, cells_, Format::RGBA32F), new_r(*gpu_, cells_, Format::RGBA32F),
        p(*gpu_, cells_, Format::RGBA32F), q(*gpu_, cells_, Format::RGBA32F);
    passes.step.draw(inputs, {}, {&new_phi.texture(), &new_r.texture(), &p.texture(), &q.texture()});
    phi = std::move(new_phi);
    r = std::move(new_r);
    p_ = std::move(p);
    q_ = std::move(q);
}

}  // namespace eddy::gles
