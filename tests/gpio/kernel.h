#pragma once
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace eddy::gpio {

/// A line of an emulated chip.
struct Line {
    std::string name;
    bool high = true;  ///< its voltage
    bool used = false;
    bool output = false;
    std::string consumer{};
};

struct Chip {
    std::string label;
    std::deque<Line> lines;
    bool edges = true;             ///< it can interrupt
    bool biases = true;            ///< the kernel knows of pull-ups, as from 5.5 on
    int refusal = 0;               ///< errno of every open()
    std::filesystem::path file{};  ///< while plugged in: stands for its device file
    unsigned pull_ups = 0;         ///< requests that asked for one
};

/// The part of a kernel that libgpiod sees: GPIO character devices with their ioctls, those of libgpiod 1 and those of libgpiod 2.
/// A program that links kernel.cpp reaches them through the functions of its own C library. The device files are plain files in a
/// folder of the test's. Any thread.
class Kernel {
  public:
    /// Each program has one.
    static Kernel& instance();

    /// A chip whose device file is `file`, which exists.
    Chip& add(const std::filesystem::path& file, const std::string& label,
              const std::vector<std::string>& names, bool edges = true);
    /// The file is removed, what is open of it hangs up.
    void unplug(Chip& chip);
    void plug_in(Chip& chip, const std::filesystem::path& file);
    void clear();

    void set_high(Chip& chip, std::size_t line, bool high);
    bool is_high(const Chip& chip, std::size_t line);

    // --- for the functions of the C library -----------------------------------------------------------------------

    /// Null if the path is not that of a chip.
    Chip* chip_at(const char* path);
    bool has_chips();
    /// These return what the system call would, with errno set.
    int open_chip(Chip& chip);
    bool is_open(int fd);
    int ioctl(int fd, unsigned long request, void* argument);
    void close(int fd);

  private:
    struct Open {
        Chip* chip = nullptr;
        bool is_line = false;
        std::size_t line = 0;
        bool active_low = false;
        bool output = false;
        bool tells_edges = false;
        bool second = false;  ///< requested by the second generation of the interface
        int far_end = -1;     ///< the kernel's end of the pipe that the program reads events from
    };
    int request(Chip& chip, std::size_t line, const char* consumer, Open wish, bool pull_up, bool value);
    int chip_ioctl(Open& open, unsigned long request, void* argument);
    int line_ioctl(Open& open, unsigned long request, void* argument);
    void change(Chip& chip, std::size_t line, bool high);

    std::recursive_mutex mutex_;
    std::deque<Chip> chips_;
    std::map<int, Open> open_;
};

}  // namespace eddy::gpio
