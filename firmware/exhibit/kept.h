#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace eddy {

/// What a file of the state folder holds; nothing if there is none, or it cannot be read.
std::optional<std::string> kept(const std::filesystem::path& file);
/// Replaces it in one step, so that a power cut leaves the old text or the new one. False if the disk is full or gone: that must
/// not stop the show.
bool keep(const std::filesystem::path& file, std::string_view text);

}  // namespace eddy
