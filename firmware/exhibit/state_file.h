#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/disk.h"

namespace eddy {

/// A file that outlives the program and the power. Its last line is a sum over the rest, so that a torn one is noticed. One
/// thread.
class StateFile {
  public:
    explicit StateFile(std::filesystem::path file, Disk& disk = real_disk());

    /// What was written last, whole; nothing if that is not there, or is not what was written.
    std::optional<std::string> read();
    /// How often it was there and was not what had been written.
    int unreadable() const { return unreadable_; }

    /// Makes the folder if need be. Throws std::runtime_error; then the old text stays.
    void write(std::string_view text);
    /// The same for what must not stop the show: false in place of the exception.
    bool try_write(std::string_view text);
    /// No error if it is not there. Throws std::runtime_error.
    void remove();

    const std::filesystem::path& path() const { return file_; }

  private:
    std::filesystem::path file_;
    Disk& disk_;
    int unreadable_ = 0;
};

}  // namespace eddy
