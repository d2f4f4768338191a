#include "gles/render/text.h"

namespace eddy::gles {

Text::Text(Gpu& gpu, const Texture& picture)
    : gpu_(gpu),
      picture_(picture),
      lay_(gpu, "text", "gles/render/text.frag", AtlasLayout{{picture.size(), 1}, 1}) {}

void Text::draw(const Page& page) {
    if (page.empty()) return;
    Gpu::Stage stage(gpu_, "text");
    if (page != composed_) {
        if (!page_ || page.size_px != composed_.size_px)
            page_ = gpu_.textures().lease(page.size_px, Format::RGBA8);
        page_.get()->upload(compose(page, font_).data());
        composed_ = page;
    }
    const glm::ivec2 low(page.corner_px.x, picture_.size().y - page.corner_px.y - page.size_px.y);
    lay_.draw({{"page", &*page_}}, {{"corner", glm::vec2(page.corner_px)}}, {&picture_},
              Region(std::vector<Box>{{{low, 0}, {low + page.size_px, 1}}}), Onto::Over);
}

}  // namespace eddy::gles
