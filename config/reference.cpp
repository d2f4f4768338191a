#include "config/reference.h"

#include <fmt/format.h>

namespace eddy {

std::string Reference::text() const {
    const std::string head = "| key | holds | range | default | meaning |\n|---|---|---|---|---|\n";
    return (rows_.empty() ? "" : head + rows_) + tables_;
}

void Reference::add_row(std::string_view key, std::string_view type, const std::string& range,
                        std::string_view otherwise, std::string_view doc, const std::string& words) {
    rows_ += fmt::format("| `{}` | {} | {} | {} | {}{}{} |\n", key, type, range, otherwise, doc,
                         words.empty() ? "" : ": ", words);
}

}  // namespace eddy
