#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "firmware/disk.h"

namespace eddy {

/// The whole file. Throws std::runtime_error naming the file and the system's reason.
std::string read_text_file(const std::filesystem::path& file);

/// Replaces the file in one step: written beside it, flushed to the disk, renamed over it, and the name flushed too. A reader,
/// or a power cut, finds the old text or the new one; once this has returned, the new one. Throws std::runtime_error; nothing
/// half-written stays behind.
void replace_text_file(const std::filesystem::path& file, std::string_view text, Disk& disk = real_disk());

/// Whether there is such a folder; one that the system will not tell of counts as none.
bool is_folder(const std::filesystem::path& folder);

/// Makes the folder and those above it. Throws std::runtime_error naming it and the system's reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace eddy
