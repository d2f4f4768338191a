// The GPIO of the machine through libgpiod 2.x (Debian 13). libgpiod1.cpp is the same for 1.6.

#include <gpiod.h>
#include <poll.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "hal/gpio/chip_files.h"
#include "hal/gpio/real_gpio.h"

namespace eddy {
namespace {

/// Owns what one of libgpiod's functions made, and gives it back by another.
template <auto Free>
struct GiveBack {
    template <class T>
    void operator()(T* thing) const {
        Free(thing);
    }
};
using Chip = std::unique_ptr<gpiod_chip, GiveBack<gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, GiveBack<gpiod_chip_info_free>>;
using LineInfo = std::unique_ptr<gpiod_line_info, GiveBack<gpiod_line_info_free>>;
using LineSettings = std::unique_ptr<gpiod_line_settings, GiveBack<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, GiveBack<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, GiveBack<gpiod_request_config_free>>;
using Request = std::unique_ptr<gpiod_line_request, GiveBack<gpiod_line_request_release>>;
using Events = std::unique_ptr<gpiod_edge_event_buffer, GiveBack<gpiod_edge_event_buffer_free>>;

[[noreturn]] void fail(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
}

std::string text_of(const char* text) {
    return text ? text : "";
}

/// Who asks for the same again in another way would get the same answer.
bool is_final(int error) {
    return error == EBUSY || error == EACCES || error == EPERM;
}

class Line final : public GpioLine {
  public:
    Line(const std::string& path, unsigned offset, const GpioWish& wish)
        : offset_(offset), chip_(gpiod_chip_open(path.c_str())), events_(gpiod_edge_event_buffer_new(16)) {
        if (!chip_ || !events_) fail("open");
        if (wish.output) {
            request_ = request(wish, GPIOD_LINE_EDGE_NONE, GPIOD_LINE_BIAS_AS_IS);
            if (!request_) fail("request");
        } else {
            request_input(wish);
        }
    }

    bool active() override {
        const gpiod_line_value value = gpiod_line_request_get_value(request_.get(), offset_);
        if (value == GPIOD_LINE_VALUE_ERROR) fail("read");
        return value == GPIOD_LINE_VALUE_ACTIVE;
    }
    void set(bool active) override {
        if (gpiod_line_request_set_value(request_.get(), offset_,
                                         active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE) < 0)
            fail("write");
    }
    int edges_fd() const override { return edges_ ? gpiod_line_request_get_fd(request_.get()) : -1; }
    bool take_edges() override {
        pollfd waiting{edges_fd(), POLLIN, 0};
        bool rose = false;
        while (waiting.fd >= 0 && poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLIN) != 0) {
            const int events = gpiod_line_request_read_edge_events(request_.get(), events_.get(), 16);
            if (events < 0) break;  // active() will say why
            for (int i = 0; i < events; ++i) {
                gpiod_edge_event* event =
                    gpiod_edge_event_buffer_get_event(events_.get(), static_cast<unsigned long>(i));
                rose |= gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
            }
        }
        return rose;
    }

  private:
    /// Null, with errno set, if it is refused.
    Request request(const GpioWish& wish, gpiod_line_edge edge, gpiod_line_bias bias) const {
        const LineSettings settings(gpiod_line_settings_new());
        const LineConfig lines(gpiod_line_config_new());
        const RequestConfig config(gpiod_request_config_new());
        if (!settings || !lines || !config) return nullptr;
        gpiod_line_settings_set_direction(
            settings.get(), wish.output ? GPIOD_LINE_DIRECTION_OUTPUT : GPIOD_LINE_DIRECTION_INPUT);
        gpiod_line_settings_set_active_low(settings.get(), wish.active_low);
        gpiod_line_settings_set_output_value(settings.get(), GPIOD_LINE_VALUE_INACTIVE);
        gpiod_line_settings_set_edge_detection(settings.get(), edge);
        gpiod_line_settings_set_bias(settings.get(), bias);
        if (gpiod_line_config_add_line_settings(lines.get(), &offset_, 1, settings.get()) < 0) return nullptr;
        gpiod_request_config_set_consumer(config.get(), "eddy");
        return Request(gpiod_chip_request_lines(chip_.get(), config.get(), lines.get()));
    }
    /// With edges and pull-up; without what the chip does not have.
    void request_input(const GpioWish& wish) {
        for (const gpiod_line_edge edge : {GPIOD_LINE_EDGE_BOTH, GPIOD_LINE_EDGE_NONE})
            for (const gpiod_line_bias bias : {GPIOD_LINE_BIAS_PULL_UP, GPIOD_LINE_BIAS_AS_IS}) {
                edges_ = edge == GPIOD_LINE_EDGE_BOTH;
                request_ = request(wish, edge, bias);
                if (request_) return;
                if (is_final(errno)) fail("request");
            }
        fail("request");
    }

    unsigned offset_;
    Chip chip_;
    Request request_;
    Events events_;
    bool edges_ = false;
};

class RealGpio final : public Gpio {
  public:
    explicit RealGpio(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::vector<GpioChip> chips() override {
        std::vector<GpioChip> all;
        for (const auto& file : chip_files(folder_)) all.push_back(look_into(file));
        return all;
    }
    std::unique_ptr<GpioLine> request(const std::string& chip_path, unsigned offset,
                                      const GpioWish& wish) override {
        return std::make_unique<Line>(chip_path, offset, wish);
    }

  private:
    static GpioChip look_into(const std::filesystem::path& file) {
        const Chip chip(gpiod_chip_open(file.c_str()));
        const ChipInfo about(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
        GpioChip seen{.path = file.string(), .name = file.filename().string(), .label = {}, .trouble = {}};
        if (!about) {
            seen.trouble = why_not_opened(file, errno);
            return seen;
        }
        seen.label = gpiod_chip_info_get_label(about.get());
        for (unsigned i = 0; i < gpiod_chip_info_get_num_lines(about.get()); ++i) {
            const LineInfo line(gpiod_chip_get_line_info(chip.get(), i));
            // A chip that goes away meanwhile has no lines any more.
            if (!line) break;
            seen.lines.push_back({text_of(gpiod_line_info_get_name(line.get())),
                                  text_of(gpiod_line_info_get_consumer(line.get())),
                                  gpiod_line_info_is_used(line.get()),
                                  gpiod_line_info_get_direction(line.get()) == GPIOD_LINE_DIRECTION_OUTPUT});
        }
        return seen;
    }

    std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<Gpio> make_real_gpio(const std::filesystem::path& folder) {
    return std::make_unique<RealGpio>(folder);
}

}  // namespace eddy
