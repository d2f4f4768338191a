#include "firmware/dated_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <system_error>

namespace eddy {

std::vector<std::filesystem::path> dated_files(const std::filesystem::path& folder, std::string_view prefix,
                                               std::string_view extension) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == extension && entry->path().filename().string().starts_with(prefix))
            files.push_back(entry->path());
    std::sort(files.begin(), files.end(), std::greater<>());
    return files;
}

std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                  std::string_view extension) {
    std::filesystem::path file = folder / fmt::format("{}{}", stem, extension);
    for (int n = 2; std::filesystem::exists(file); ++n)
        file = folder / fmt::format("{}-{}{}", stem, n, extension);
    return file;
}

void keep_newest(const std::vector<std::filesystem::path>& files, std::size_t most,
                 const std::filesystem::path& written) {
    std::size_t left = files.size();
    std::error_code ignored;
    for (auto file = files.rbegin(); file != files.rend() && left > most; ++file)
        if (*file != written && std::filesystem::remove(*file, ignored)) --left;
}

}  // namespace eddy
