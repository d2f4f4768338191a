#include "config/json_schema.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "config/unit.h"

namespace eddy {
namespace {

using Json = nlohmann::ordered_json;

// 8, not 8.0: TOML writes a whole number in both ways.
Json number(double x) {
    if (x == std::floor(x) && std::fabs(x) < 1e15) return static_cast<std::int64_t>(x);
    return x;
}

void add_range(Json& j, const Range& range) {
    if (std::isfinite(range.low)) j[range.low_excluded ? "exclusiveMinimum" : "minimum"] = number(range.low);
    if (std::isfinite(range.high)) j["maximum"] = number(range.high);
}

}  // namespace

struct JsonSchema::Object {
    Json json{{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
};

JsonSchema::JsonSchema(TakesEffect takes_effect)
    : object_(std::make_unique<Object>()), takes_effect_(takes_effect) {}
JsonSchema::~JsonSchema() = default;
JsonSchema::JsonSchema(JsonSchema&&) noexcept = default;

void JsonSchema::add(std::string_view key, const Kind& kind, std::string_view doc,
                     const std::string& otherwise) {
    Json one{{"type", kind.type}};
    for (const std::string_view word : kind.words) one["enum"].push_back(word);
    add_range(one, kind.range);
    Json j;
    if (kind.list) {
        j = {{"type", "array"}, {"items", one}};
        if (kind.length > 0) j["minItems"] = j["maxItems"] = kind.length;
    } else {
        j = one;
    }
    j["description"] = fmt::format("{}{}{}", doc, kind.word_docs.empty() ? "" : ". ", kind.word_docs);
    if (!otherwise.empty()) {
        j["default"] = Json::parse(otherwise);
        if (j["default"].is_number()) j["default"] = number(j["default"].get<double>());
    }
    if (const std::string_view unit = unit_of(key); !unit.empty()) j["x-unit"] = unit;
    j["x-takes-effect"] = to_word(takes_effect_);
    object_->json["properties"][std::string(key)] = std::move(j);
}

void JsonSchema::add_table(std::string_view key, const JsonSchema& inside, std::string_view doc, bool list) {
    Json j = inside.object_->json;
    if (list)
        j = {{"type", "array"}, {"description", doc}, {"items", std::move(j)}};
    else
        j["description"] = doc;
    object_->json["properties"][std::string(key)] = std::move(j);
}

void JsonSchema::require(std::string_view key) {
    object_->json["required"].push_back(key);
}

std::string JsonSchema::text(const std::string& title) const {
    Json j{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
    j.update(object_->json);
    return j.dump(2) + "\n";
}

}  // namespace eddy
