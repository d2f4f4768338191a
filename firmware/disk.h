#pragma once
#include <filesystem>
#include <string_view>

namespace eddy {

/// What keeping a file through a power cut takes of the operating system. A test stands in for it and cuts the power. Each
/// throws std::system_error.
class Disk {
  public:
    virtual ~Disk() = default;
    /// Makes the file, or empties it; writes; what it holds is on the disk when this returns. Its name may not be yet.
    virtual void write(const std::filesystem::path& file, std::string_view bytes) = 0;
    virtual void rename(const std::filesystem::path& from, const std::filesystem::path& to) = 0;
    /// No error if it is not there.
    virtual void remove(const std::filesystem::path& file) = 0;
    /// No error if it is there.
    virtual void make_folder(const std::filesystem::path& folder) = 0;
    /// The names in the folder are on the disk when this returns.
    virtual void flush_folder(const std::filesystem::path& folder) = 0;
};

/// The machine's own.
Disk& real_disk();

}  // namespace eddy
