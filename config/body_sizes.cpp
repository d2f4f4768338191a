#include "config/body_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace eddy {
namespace {

const SizeKey& size_key(std::string_view key) {
    return *std::find_if(std::begin(kSizeKeys), std::end(kSizeKeys),
                         [&](const SizeKey& size) { return size.key == key; });
}

}  // namespace

bool has_size(BodyShape shape, std::string_view key) {
    return belongs_to(size_key(key), shape);
}

std::string sizes_of(BodyShape shape) {
    std::string out;
    for (const SizeKey& size : kSizeKeys) {
        if (belongs_to(size, shape)) out += fmt::format("{}{}", out.empty() ? "" : ", ", size.key);
    }
    return out;
}

std::string shapes_with(std::string_view key) {
    std::string out;
    for (const Word<BodyShape>& shape : kBodyShapes) {
        if (has_size(shape.value, key)) out += fmt::format("{}`{}`", out.empty() ? "" : ", ", shape.word);
    }
    return "must be given for " + out;
}

}  // namespace eddy
