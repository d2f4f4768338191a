#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <string_view>

namespace eddy {

/// The last lines of the log in memory that is there from the start, so that a signal handler may write them out. One thread adds.
class LineRing {
  public:
    static constexpr std::size_t kLines = 200, kLength = 240;

    /// What is too long is cut off.
    void add(std::string_view line);
    /// The oldest first, each with its line end. Async-signal-safe; a line that is being added may be torn.
    void write_to(int fd) const;

  private:
    struct Line {
        std::array<char, kLength> text{};
        std::size_t length = 0;
    };
    std::array<Line, kLines> lines_{};
    std::atomic<std::size_t> added_{0};
};

}  // namespace eddy
