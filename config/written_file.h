#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace eddy {

/// A file as it was read.
struct WrittenFile {
    std::filesystem::path path;
    std::string text;
    bool operator==(const WrittenFile&) const = default;
};

enum class Links { Follow, Refuse };

inline constexpr std::size_t kMostConfigBytes = 1 << 20;

/// Reads a configuration file that somebody may be writing at this very moment, or was when the power went. It must be a
/// plain file of at most 1 MiB, must not be empty, hold no bytes of 0 and end with the end of a line; if a file of its name
/// with .sha256 at the end lies beside it (as sha256sum writes it), it must be what that says. What was read is added to
/// `read`, the sum's file too, also when it is then refused. Throws ConfigError.
std::string read_written_file(const std::filesystem::path& path, Links links, std::vector<WrittenFile>& read);

/// Any file whole, up to `most` bytes. Throws ConfigError.
std::string read_whole_file(const std::filesystem::path& path, Links links, std::size_t most);

}  // namespace eddy
