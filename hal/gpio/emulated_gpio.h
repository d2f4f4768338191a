#pragma once
#include <mutex>

#include "hal/gpio/gpio.h"

namespace eddy {

/// GPIO that somebody plays by hand: chips, the voltage of their lines, and their faults. Any thread.
class EmulatedGpio final : public Gpio {
  public:
    struct Line {
        GpioLineInfo info{};
        bool high = true;  ///< its voltage; an input that nothing pulls down is pulled up
        std::vector<bool>
            chatter;      ///< of its contact: the next reads find these, the last first, before `high`
        int refusal = 0;  ///< errno of every request for it
    };
    struct Chip {
        std::string label;
        std::vector<Line> lines{};
        bool edges = true;  ///< it tells of them
        bool plugged_in = true;
        std::string trouble{};  ///< as in GpioChip
    };

    EmulatedGpio() : shared_(std::make_shared<Shared>()) {}
    /// A chip whose lines have these names; its path is /dev/gpiochip0, 1, ...
    void add(const std::string& label, const std::vector<std::string>& line_names, bool edges = true);

    // `address` as in find_line.h; they throw GpioError if there is no such line.
    void set_high(const std::string& address, bool high);
    bool is_high(const std::string& address) const;
    /// The contact bounces: the next reads find these voltages, in this order, then the one that is set.
    void bounce(const std::string& address, std::vector<bool> high);
    void use_elsewhere(const std::string& address, const std::string& consumer);
    void refuse(const std::string& address, int error);
    /// A USB bridge goes, with all its lines, and comes back.
    void unplug(const std::string& label) { plug(label, false); }
    void plug_in(const std::string& label) { plug(label, true); }
    void deny(const std::string& label, const std::string& trouble);

    std::vector<GpioChip> chips() override;
    std::unique_ptr<GpioLine> request(const std::string& chip_path, unsigned offset,
                                      const GpioWish& wish) override;

  private:
    class Requested;
    struct Shared {
        std::mutex mutex;
        std::vector<Chip> chips;
        std::vector<Requested*> requested;
    };
    struct Spot {
        std::size_t chip, line;
        bool operator==(const Spot&) const = default;
    };
    Spot spot_of(const std::string& address) const;
    void plug(const std::string& label, bool in);

    std::shared_ptr<Shared> shared_;
};

}  // namespace eddy
