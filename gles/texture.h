#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace eddy::gles {

enum class Format { R32F, RG32F, RGBA32F, R16F, RGBA16F, RGBA8 };
std::size_t bytes_per_texel(Format format);
const char* to_string(Format format);

/// A 2D texture without mipmaps; clamps at its edge; filters linearly where the driver can for its format.
class Texture {
  public:
    Texture(const glm::ivec2& size, Format format, bool linear);
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    unsigned id() const { return id_; }
    /// Never given twice, unlike GL's id, which a driver may hand out again after the texture is gone.
    std::uint64_t serial() const { return serial_; }
    glm::ivec2 size() const { return size_; }
    Format format() const { return format_; }
    std::size_t bytes() const;

    /// Replaces the content: size.x * size.y texels, row by row, as floats of the format's channel count.
    void upload(const float* texels);
    /// The same for RGBA8: four bytes a texel.
    void upload(const std::uint8_t* texels);
    /// Waits for the GPU. RGBA floats for float formats, whatever the channel count (missing channels are 0,
    /// alpha 1).
    std::vector<glm::vec4> download() const;

  private:
    unsigned id_ = 0;
    std::uint64_t serial_;
    glm::ivec2 size_;
    Format format_;
};

/// Textures come from here and go back when their Lease dies, so that ping-pong needs no bookkeeping and a
/// running simulation allocates nothing after its first step.
class TexturePool {
  public:
    explicit TexturePool(bool filters_float) : filters_float_(filters_float) {}

    class Lease {
      public:
        Lease() = default;
        Lease(TexturePool* pool, std::unique_ptr<Texture> texture)
            : pool_(pool), texture_(std::move(texture)) {}
        Lease(Lease&&) noexcept = default;
        Lease& operator=(Lease&& other) noexcept;
        ~Lease() { give_back(); }
        const Texture& operator*() const { return *texture_; }
        Texture* get() const { return texture_.get(); }
        explicit operator bool() const { return texture_ != nullptr; }

      private:
        void give_back();
        TexturePool* pool_ = nullptr;
        std::unique_ptr<Texture> texture_;
    };

    /// A texture of unknown content.
    Lease lease(const glm::ivec2& size, Format format);
    /// Hands over the textures that nobody holds; who lets them go must let go of the framebuffers with them first.
    std::vector<std::unique_ptr<Texture>> take_idle();
    /// Textures made since start, and the bytes of all that exist now.
    std::size_t made() const { return made_; }
    std::size_t bytes() const { return bytes_; }

  private:
    bool filters_float_;
    std::size_t made_ = 0;
    std::size_t bytes_ = 0;
    std::vector<std::unique_ptr<Texture>> idle_;
};

}  // namespace eddy::gles
