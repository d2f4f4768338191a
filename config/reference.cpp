#include "config/reference.h"

#include <fmt/format.h>

#include "config/unit.h"

namespace eddy {

std::string Reference::text() const {
    const std::string head = keys_ == Keys::OfScene
                                 ? "| key | holds | range | default | meaning |\n|---|---|---|---|---|\n"
                                 : "| key | holds | unit | range | default | takes effect | meaning |\n"
                                   "|---|---|---|---|---|---|---|\n";
    return (rows_.empty() ? "" : head + rows_) + tables_;
}

void Reference::add_row(std::string_view key, std::string_view type, const std::string& range,
                        std::string_view otherwise, std::string_view doc, const std::string& words) {
    const std::string meaning = fmt::format("{}{}{}", doc, words.empty() ? "" : ": ", words);
    if (keys_ == Keys::OfScene)
        rows_ += fmt::format("| `{}` | {} | {} | {} | {} |\n", key, type, range, otherwise, meaning);
    else
        rows_ += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", key, type, unit_of(key), range,
                             otherwise, to_word(takes_effect_), meaning);
}

}  // namespace eddy
