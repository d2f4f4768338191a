#include "gles/fluid/resample.h"

#include <fmt/format.h>

namespace eddy::gles {
namespace {

constexpr const char* kCopy = "gles/copy.frag";
constexpr const char* kVelocity = "gles/fluid/resample_velocity.frag";
constexpr const char* kScalar = "gles/fluid/resample.frag";

}  // namespace

Pass& Resample::pass(const char* shader, const AtlasLayout& target, const Variant& variant) {
    std::string name = fmt::format("take over by {}", shader);
    for (const auto& [define, value] : variant.defines) name += fmt::format(" {} {}", define, value);
    name += fmt::format(" {} {} {}", target.size.x, target.size.y, target.size.z);
    const auto found = passes_.find(name);
    if (found != passes_.end()) return found->second;
    return passes_.emplace(name, Pass(*gpu_, name, shader, target, variant)).first->second;
}

template <class To, class From>
Field<To> Resample::draw(const char* shader, const Field<From>& source, Format format, Variant variant,
                         const std::vector<Uniform>& uniforms) {
    Field<To> result(*gpu_, cells_, format);
    const bool same = std::is_same_v<To, From> && source.cells() == cells_;
    if (same) {
        pass(kCopy, result.layout(), {}).draw({{"field", &source.texture()}}, {}, {&result.texture()});
        return result;
    }
    variant.layouts.emplace_back("SOURCE", source.layout());
    variant.defines.emplace_back("CELLS", glsl(cells_));
    variant.defines.emplace_back("SOURCE_CELLS", glsl(source.cells()));
    pass(shader, result.layout(), variant)
        .draw({{"source", &source.texture()}}, uniforms, {&result.texture()});
    return result;
}

Field<Faces> Resample::on_faces(const Field<Faces>& u) {
    return draw<Faces>(kVelocity, u, Format::RGBA32F, {}, {});
}

Field<Faces> Resample::on_faces(const Field<Cells>& u) {
    return draw<Faces>(kVelocity, u, Format::RGBA32F, {.defines = {{"FROM_CENTRES", ""}}}, {});
}

Field<Cells> Resample::at_centres(const Field<Faces>& u) {
    return draw<Cells>(kVelocity, u, Format::RGBA32F, {.defines = {{"TO_CENTRES", ""}}}, {});
}

Field<Cells> Resample::at_centres(const Field<Cells>& u) {
    return draw<Cells>(kVelocity, u, Format::RGBA32F, {.defines = {{"FROM_CENTRES", ""}, {"TO_CENTRES", ""}}},
                       {});
}

Field<Cells> Resample::in_cells(const Field<Cells>& s, float gain) {
    return draw<Cells>(kScalar, s, Format::R32F, {}, {{"gain", gain}});
}

Field<Cells> Resample::in_cells(const Field<Cells4>& s, float gain) {
    return draw<Cells>(kScalar, s, Format::R32F, {.defines = {{"FROM_FOUR", ""}}}, {{"gain", gain}});
}

Field<Cells4> Resample::in_fours(const Field<Cells4>& s, float gain) {
    return draw<Cells4>(kScalar, s, Format::RGBA32F, {.defines = {{"FROM_FOUR", ""}, {"TO_FOUR", ""}}},
                        {{"gain", gain}});
}

Field<Cells4> Resample::in_fours(const Field<Cells>& s, float gain) {
    return draw<Cells4>(kScalar, s, Format::RGBA32F, {.defines = {{"TO_FOUR", ""}}}, {{"gain", gain}});
}

}  // namespace eddy::gles
