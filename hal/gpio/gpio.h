#pragma once
#include <memory>
#include <string>
#include <vector>

namespace eddy {

/// A line, as the kernel tells of it.
struct GpioLineInfo {
    std::string name;  ///< from the board's description; many lines have none, and USB bridges none at all
    std::string consumer;  ///< who uses it; empty: it does not say, or nobody does
    bool used = false;
    bool output = false;
};

/// A chip with GPIO lines: of the board itself, or of a USB bridge.
struct GpioChip {
    std::string path;   ///< device file, as /dev/gpiochip0: its number is another after the next start
    std::string name;   ///< gpiochip0
    std::string label;  ///< what it is: pinctrl-bcm2711, cp2112_gpio
    std::string
        trouble;  ///< why it cannot be looked into, and the cure; empty: it can, and these are its lines
    std::vector<GpioLineInfo> lines{};
};

struct GpioWish {
    bool output = false;      ///< else an input, with a pull-up where the chip has them
    bool active_low = false;  ///< active means 0 V
};

/// A line of which somebody is the owner; given back when this ends. One thread at a time. Calls may take some milliseconds
/// on a USB bridge. Whatever the kernel refuses is thrown as std::system_error: mostly ENODEV, for a bridge was unplugged.
class GpioLine {
  public:
    virtual ~GpioLine() = default;
    virtual bool active() = 0;
    /// Of an output.
    virtual void set(bool active) = 0;
    /// A file that becomes readable when an input changes; -1: this chip tells no edges, ask active() again and again.
    virtual int edges_fd() const = 0;
    /// Takes what waits there: whether the input became active meanwhile, however shortly.
    virtual bool take_edges() = 0;
};

/// The GPIO of a machine. Real: libgpiod1.cpp or libgpiod2.cpp. Emulated: emulated_gpio.h.
class Gpio {
  public:
    virtual ~Gpio() = default;
    /// Those that are there now.
    virtual std::vector<GpioChip> chips() = 0;
    /// An output begins inactive. Throws std::system_error: EBUSY, EACCES, ENODEV, ...; find_line.h says it in words.
    virtual std::unique_ptr<GpioLine> request(const std::string& chip_path, unsigned offset,
                                              const GpioWish& wish) = 0;
};

}  // namespace eddy
