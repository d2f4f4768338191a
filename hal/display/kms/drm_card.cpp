#include "hal/display/kms/drm_card.h"

#include <drm_fourcc.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cerrno>
#include <ctime>
#include <set>

namespace eddy::kms {
namespace {

/// What libdrm hands out, and what frees it.
template <auto Free>
struct Freed {
    template <class T>
    void operator()(T* p) const {
        Free(p);
    }
};
template <class T, auto Free>
using Owned = std::unique_ptr<T, Freed<Free>>;

/// libdrm answers -1 and errno here, a negative errno there.
int error_of(int result) {
    return result == 0 ? 0 : result < -1 ? -result : errno != 0 ? errno : EIO;
}

std::vector<Property> properties_of(int fd, std::uint32_t object, std::uint32_t type) {
    std::vector<Property> result;
    const Owned<drmModeObjectProperties, drmModeFreeObjectProperties> all(
        drmModeObjectGetProperties(fd, object, type));
    if (!all) return result;
    for (std::uint32_t i = 0; i < all->count_props; ++i) {
        const Owned<drmModePropertyRes, drmModeFreeProperty> p(drmModeGetProperty(fd, all->props[i]));
        if (p) result.push_back({p->prop_id, p->name, all->prop_values[i]});
    }
    return result;
}

Connection connection_of(drmModeConnection c) {
    return c == DRM_MODE_CONNECTED      ? Connection::Connected
           : c == DRM_MODE_DISCONNECTED ? Connection::Disconnected
                                        : Connection::Unknown;
}

class DrmCard final : public Card {
  public:
    DrmCard(std::string path, int fd) : path_(std::move(path)), fd_(fd) {
        std::uint64_t value = 0;
        has_modifiers_ = drmGetCap(fd_, DRM_CAP_ADDFB2_MODIFIERS, &value) == 0 && value != 0;
    }
    ~DrmCard() override { close(fd_); }
    DrmCard(const DrmCard&) = delete;
    DrmCard& operator=(const DrmCard&) = delete;

    std::string path() const override { return path_; }
    int fd() const override { return fd_; }
    bool is_master() const override { return drmIsMaster(fd_) != 0; }
    int take_master() override { return error_of(drmSetMaster(fd_)); }
    void drop_master() override { drmDropMaster(fd_); }
    bool enable_atomic() override {
        return drmSetClientCap(fd_, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) == 0 &&
               drmSetClientCap(fd_, DRM_CLIENT_CAP_ATOMIC, 1) == 0;
    }
    bool has_modifiers() const override { return has_modifiers_; }

    std::vector<Connector> connectors(bool probe) override;
    std::vector<Crtc> crtcs() override;
    std::vector<Property> crtc_properties(std::uint32_t crtc) override {
        return properties_of(fd_, crtc, DRM_MODE_OBJECT_CRTC);
    }
    std::vector<Plane> planes() override;
    std::vector<std::uint8_t> blob(std::uint32_t id) override {
        const Owned<drmModePropertyBlobRes, drmModeFreePropertyBlob> blob(drmModeGetPropertyBlob(fd_, id));
        if (!blob) return {};
        const auto* data = static_cast<const std::uint8_t*>(blob->data);
        return {data, data + blob->length};
    }
    std::vector<FormatModifier> formats_in(std::uint32_t id) override {
        std::vector<FormatModifier> result;
        const Owned<drmModePropertyBlobRes, drmModeFreePropertyBlob> blob(drmModeGetPropertyBlob(fd_, id));
        drmModeFormatModifierIterator at{};
        while (blob && drmModeFormatModifierBlobIterNext(blob.get(), &at)) result.push_back({at.fmt, at.mod});
        return result;
    }

    int add_framebuffer(const Buffer& buffer, std::uint32_t& id) override;
    void remove_framebuffer(std::uint32_t id) override { drmModeRmFB(fd_, id); }
    int create_mode_blob(const drmModeModeInfo& mode, std::uint32_t& id) override {
        return error_of(drmModeCreatePropertyBlob(fd_, &mode, sizeof(mode), &id));
    }
    void destroy_blob(std::uint32_t id) override { drmModeDestroyPropertyBlob(fd_, id); }

    int commit(std::span<const Setting> settings, std::uint32_t flags) override;
    int set_crtc(std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t x, std::uint32_t y,
                 std::span<const std::uint32_t> connectors, const drmModeModeInfo* mode) override {
        std::vector<std::uint32_t> ids(connectors.begin(), connectors.end());
        drmModeModeInfo copy{};
        if (mode) copy = *mode;
        return error_of(drmModeSetCrtc(fd_, crtc, framebuffer, x, y, ids.data(), static_cast<int>(ids.size()),
                                       mode ? &copy : nullptr));
    }
    int page_flip(std::uint32_t crtc, std::uint32_t framebuffer) override {
        return error_of(drmModePageFlip(fd_, crtc, framebuffer, DRM_MODE_PAGE_FLIP_EVENT, nullptr));
    }
    int set_connector_property(std::uint32_t connector, std::uint32_t property,
                               std::uint64_t value) override {
        return error_of(drmModeConnectorSetProperty(fd_, connector, property, value));
    }

    std::vector<FlipEvent> events() override;
    void wait(std::chrono::milliseconds at_most) override {
        pollfd ready{fd_, POLLIN, 0};
        poll(&ready, 1, static_cast<int>(at_most.count()));
    }
    Instant clock() const override {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
    }

  private:
    /// The events of the call under way: libdrm hands back what a flip was asked with, which for commits is nothing.
    static thread_local std::vector<FlipEvent>* heard_;
    static void hear(int, unsigned sequence, unsigned s, unsigned us, unsigned crtc, void*) {
        heard_->push_back({crtc, std::chrono::seconds(s) + std::chrono::microseconds(us), sequence});
    }

    std::string path_;
    int fd_;
    bool has_modifiers_ = false;
};

thread_local std::vector<FlipEvent>* DrmCard::heard_ = nullptr;

std::vector<Connector> DrmCard::connectors(bool probe) {
    std::vector<Connector> result;
    const Owned<drmModeRes, drmModeFreeResources> resources(drmModeGetResources(fd_));
    if (!resources) return result;
    for (int i = 0; i < resources->count_connectors; ++i) {
        const Owned<drmModeConnector, drmModeFreeConnector> c(
            probe ? drmModeGetConnector(fd_, resources->connectors[i])
                  : drmModeGetConnectorCurrent(fd_, resources->connectors[i]));
        if (!c || c->connector_type == DRM_MODE_CONNECTOR_WRITEBACK) continue;
        Connector k;
        k.id = c->connector_id;
        const char* type = drmModeGetConnectorTypeName(c->connector_type);
        k.name = fmt::format("{}-{}", type ? type : "Unknown", c->connector_type_id);
        k.connection = connection_of(c->connection);
        k.modes.assign(c->modes, c->modes + c->count_modes);
        std::set<std::uint32_t> possible;
        for (int e = 0; e < c->count_encoders; ++e) {
            const Owned<drmModeEncoder, drmModeFreeEncoder> encoder(drmModeGetEncoder(fd_, c->encoders[e]));
            if (!encoder) continue;
            if (encoder->encoder_id == c->encoder_id) k.crtc_now = encoder->crtc_id;
            for (int bit = 0; bit < resources->count_crtcs; ++bit)
                if ((encoder->possible_crtcs >> bit & 1U) != 0) possible.insert(resources->crtcs[bit]);
        }
        k.crtcs.assign(possible.begin(), possible.end());
        k.properties = properties_of(fd_, k.id, DRM_MODE_OBJECT_CONNECTOR);
        result.push_back(std::move(k));
    }
    return result;
}

std::vector<Crtc> DrmCard::crtcs() {
    std::vector<Crtc> result;
    const Owned<drmModeRes, drmModeFreeResources> resources(drmModeGetResources(fd_));
    for (int i = 0; resources && i < resources->count_crtcs; ++i) {
        const Owned<drmModeCrtc, drmModeFreeCrtc> c(drmModeGetCrtc(fd_, resources->crtcs[i]));
        if (!c) continue;
        result.push_back({c->crtc_id, c->buffer_id, c->x, c->y, {}});
        if (c->mode_valid != 0) result.back().mode = c->mode;
    }
    return result;
}

std::vector<Plane> DrmCard::planes() {
    std::vector<Plane> result;
    const Owned<drmModeRes, drmModeFreeResources> resources(drmModeGetResources(fd_));
    const Owned<drmModePlaneRes, drmModeFreePlaneResources> all(drmModeGetPlaneResources(fd_));
    for (std::uint32_t i = 0; resources && all && i < all->count_planes; ++i) {
        const Owned<drmModePlane, drmModeFreePlane> p(drmModeGetPlane(fd_, all->planes[i]));
        if (!p) continue;
        Plane plane;
        plane.id = p->plane_id;
        for (int bit = 0; bit < resources->count_crtcs; ++bit)
            if ((p->possible_crtcs >> bit & 1U) != 0) plane.crtcs.push_back(resources->crtcs[bit]);
        plane.formats.assign(p->formats, p->formats + p->count_formats);
        plane.properties = properties_of(fd_, plane.id, DRM_MODE_OBJECT_PLANE);
        result.push_back(std::move(plane));
    }
    return result;
}

int DrmCard::add_framebuffer(const Buffer& b, std::uint32_t& id) {
    Buffer own = b;
    std::set<std::uint32_t> imported;
    if (b.owner_fd != fd_) {
        // Drawn in the memory of the card as it was opened first: the same memory, by a name of this file's.
        for (int i = 0; i < b.planes; ++i) {
            int prime = -1;
            if (drmPrimeHandleToFD(b.owner_fd, b.handles[i], O_CLOEXEC, &prime) != 0) return errno;
            const int result = drmPrimeFDToHandle(fd_, prime, &own.handles[i]);
            const int error = errno;
            close(prime);
            if (result != 0) return error;
            imported.insert(own.handles[i]);
        }
    }
    int error = 0;
    if (has_modifiers_ && b.modifier != DRM_FORMAT_MOD_INVALID) {
        std::uint64_t modifiers[4]{};
        for (int i = 0; i < b.planes; ++i) modifiers[i] = b.modifier;
        error =
            error_of(drmModeAddFB2WithModifiers(fd_, b.width, b.height, b.format, own.handles, own.pitches,
                                                own.offsets, modifiers, &id, DRM_MODE_FB_MODIFIERS));
    } else {
        error = error_of(
            drmModeAddFB2(fd_, b.width, b.height, b.format, own.handles, own.pitches, own.offsets, &id, 0));
        if (error != 0 && b.format == DRM_FORMAT_XRGB8888)  // drivers that know only the oldest call
            error =
                error_of(drmModeAddFB(fd_, b.width, b.height, 24, 32, own.pitches[0], own.handles[0], &id));
    }
    for (const std::uint32_t handle : imported)
        drmCloseBufferHandle(fd_, handle);  // the framebuffer keeps its own
    return error;
}

int DrmCard::commit(std::span<const Setting> settings, std::uint32_t flags) {
    const Owned<drmModeAtomicReq, drmModeAtomicFree> request(drmModeAtomicAlloc());
    if (!request) return ENOMEM;
    for (const Setting& s : settings)
        if (drmModeAtomicAddProperty(request.get(), s.object, s.property, s.value) < 0) return ENOMEM;
    return error_of(drmModeAtomicCommit(fd_, request.get(), flags, nullptr));
}

std::vector<FlipEvent> DrmCard::events() {
    std::vector<FlipEvent> result;
    heard_ = &result;
    drmEventContext context{};
    context.version = 3;
    context.page_flip_handler2 = hear;
    pollfd ready{fd_, POLLIN, 0};
    while (poll(&ready, 1, 0) == 1 && (ready.revents & POLLIN) != 0)
        if (drmHandleEvent(fd_, &context) != 0) break;
    heard_ = nullptr;
    return result;
}

}  // namespace

Machine::Opened open_drm_card(const std::string& path) {
    const int fd = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) return {nullptr, errno};
    return {std::make_unique<DrmCard>(path, fd), 0};
}

}  // namespace eddy::kms
