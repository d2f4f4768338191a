#include "firmware/destination.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "firmware/input_error.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

void check_writable(std::string_view option, const std::filesystem::path& folder) {
    if (!is_folder(folder))
        throw InputError(fmt::format("{}: there is no folder {}", option, folder.string()));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw InputError(
            fmt::format("{}: {} cannot be written to: {}", option, folder.string(), std::strerror(errno)));
}

}  // namespace

void prepare_folder(std::string_view option, const std::filesystem::path& folder) {
    try {
        make_folder(folder);
    } catch (const std::runtime_error& e) {
        throw InputError(fmt::format("{}: {}", option, e.what()));
    }
    check_writable(option, folder);
}

void check_destination(std::string_view option, const std::filesystem::path& file) {
    if (is_folder(file))
        throw InputError(fmt::format("{}: {} is a folder; name a file", option, file.string()));
    check_writable(option, file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
}

}  // namespace eddy
