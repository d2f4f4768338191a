// The GPIO of the machine through libgpiod 1.6 (Debian 12). libgpiod2.cpp is the same for 2.x.

#include <gpiod.h>
#include <poll.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "hal/gpio/chip_files.h"
#include "hal/gpio/real_gpio.h"

namespace eddy {
namespace {

struct CloseChip {
    void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

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
        : chip_(gpiod_chip_open(path.c_str())) {
        if (!chip_) fail("open");
        line_ = gpiod_chip_get_line(chip_.get(), offset);
        if (!line_) fail("line");
        if (wish.output)
            request(GPIOD_LINE_REQUEST_DIRECTION_OUTPUT, wish, 0);
        else
            request_input(wish);
    }
    // The chip gives back its lines when it is closed.

    bool active() override {
        const int value = gpiod_line_get_value(line_);
        if (value < 0) fail("read");
        return value == 1;
    }
    void set(bool active) override {
        if (gpiod_line_set_value(line_, active ? 1 : 0) < 0) fail("write");
    }
    int edges_fd() const override { return edges_ ? gpiod_line_event_get_fd(line_) : -1; }
    bool take_edges() override {
        pollfd waiting{edges_fd(), POLLIN, 0};
        gpiod_line_event event;
        bool rose = false;
        while (waiting.fd >= 0 && poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLIN) != 0) {
            if (gpiod_line_event_read(line_, &event) < 0) break;  // active() will say why
            rose |= event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
        }
        return rose;
    }

  private:
    void request(int type, const GpioWish& wish, int bias) {
        if (!try_request(type, wish, bias)) fail("request");
    }
    bool try_request(int type, const GpioWish& wish, int bias) {
        gpiod_line_request_config config{};
        config.consumer = "eddy";
        config.request_type = type;
        config.flags = bias | (wish.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0);
        return gpiod_line_request(line_, &config, 0) == 0;
    }
    /// With edges and pull-up; without what the chip, or a kernel before 5.5, does not have.
    void request_input(const GpioWish& wish) {
        for (const int type : {GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES, GPIOD_LINE_REQUEST_DIRECTION_INPUT})
            for (const int bias : {int{GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP}, 0}) {
                edges_ = type == GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES;
                if (try_request(type, wish, bias)) return;
                if (is_final(errno)) fail("request");
            }
        fail("request");
    }

    Chip chip_;
    gpiod_line* line_ = nullptr;  // the chip's
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
        GpioChip seen{.path = file.string(), .name = file.filename().string(), .label = {}, .trouble = {}};
        if (!chip) {
            seen.trouble = why_not_opened(file, errno);
            return seen;
        }
        seen.label = gpiod_chip_label(chip.get());
        for (unsigned i = 0; i < gpiod_chip_num_lines(chip.get()); ++i) {
            gpiod_line* line = gpiod_chip_get_line(chip.get(), i);
            // A chip that goes away meanwhile has no lines any more.
            if (!line) break;
            seen.lines.push_back({text_of(gpiod_line_name(line)), text_of(gpiod_line_consumer(line)),
                                  gpiod_line_is_used(line),
                                  gpiod_line_direction(line) == GPIOD_LINE_DIRECTION_OUTPUT});
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
