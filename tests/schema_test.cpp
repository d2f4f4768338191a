#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "config/document.h"
#include "config/exhibit.h"
#include "config/scene.h"

namespace eddy {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

std::string source_text(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(std::string(EDDY_SOURCE_DIR) + "/" + file).rdbuf();
    return text.str();
}

bool is_of_type(const Node& node, const std::string& type) {
    if (type == "object") return node.kind == Node::Kind::Table;
    if (type == "array") return node.kind == Node::Kind::List;
    if (type == "string") return node.kind == Node::Kind::Text;
    if (type == "boolean") return node.kind == Node::Kind::Bool;
    if (type == "integer") return node.kind == Node::Kind::Integer;
    return type == "number" && (node.kind == Node::Kind::Integer || node.kind == Node::Kind::Real);
}

/// What a validator would say: the part of JSON Schema that ours uses.
void validate(const Node& node, const json& schema, const std::string& path,
              std::vector<std::string>& faults) {
    if (!is_of_type(node, schema.at("type"))) return faults.push_back(path + ": type");
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), json(node.text)) == schema["enum"].end())
        faults.push_back(path + ": enum");
    const double x = node.kind == Node::Kind::Integer ? static_cast<double>(node.integer) : node.real;
    if (schema.contains("minimum") && x < schema["minimum"]) faults.push_back(path + ": minimum");
    if (schema.contains("exclusiveMinimum") && x <= schema["exclusiveMinimum"])
        faults.push_back(path + ": exclusiveMinimum");
    if (schema.contains("maximum") && x > schema["maximum"]) faults.push_back(path + ": maximum");
    for (const Node& child : node.children) {
        const std::string inside = path + "/" + child.key;
        if (node.kind == Node::Kind::List) {
            validate(child, schema.at("items"), inside, faults);
        } else if (!schema.at("properties").contains(child.key)) {
            if (schema.at("additionalProperties") == false) faults.push_back(inside + ": unknown");
        } else {
            validate(child, schema["properties"][child.key], inside, faults);
        }
    }
}

std::vector<std::string> faults_of(const std::string& toml) {
    std::vector<std::string> faults;
    validate(parse_toml(toml, "f"), json::parse(exhibit_schema()), "", faults);
    return faults;
}

TEST(ExhibitSchema, TakesTheFactorysSettingsAndHasTheirDefaults) {
    const std::string factory = source_text("config/exhibit.toml");
    EXPECT_THAT(faults_of(factory), IsEmpty());
    const json schema = json::parse(exhibit_schema());
    int keys = 0;
    for (const Node& entry : parse_toml(factory, "f").children) {
        if (entry.kind == Node::Kind::Table) continue;
        const json& otherwise = schema["properties"][entry.key]["default"];
        const json set = entry.kind == Node::Kind::Text      ? json(entry.text)
                         : entry.kind == Node::Kind::Integer ? json(entry.integer)
                         : entry.kind == Node::Kind::Real    ? json(entry.real)
                                                             : json(otherwise);
        EXPECT_EQ(otherwise, set) << entry.key;
        ++keys;
    }
    EXPECT_GT(keys, 8);
}

TEST(ExhibitSchema, RefusesWhatTheLoaderRefuses) {
    EXPECT_THAT(
        faults_of(
            "scen = \"jet\"\ndisplay = \"kmss\"\nmax_force_n = 9\npreset_s = \"1\"\npresets = [\"fats\"]\n"
            "[falcon]\nmotor_units_per_nm = 1\nkeep_homing_bit = 1\n"),
        testing::UnorderedElementsAre(
            "/scen: unknown", "/display: enum", "/max_force_n: maximum", "/preset_s: type", "/presets/: enum",
            "/falcon/motor_units_per_nm: minimum", "/falcon/keep_homing_bit: type"));
}

TEST(ExhibitSchema, SaysOfEachKeyWhatItMeansAndWhenItTakesEffect) {
    const json schema = json::parse(exhibit_schema());
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    EXPECT_EQ(schema["properties"]["max_force_n"]["x-takes-effect"], "live");
    EXPECT_EQ(schema["properties"]["max_force_n"]["x-unit"], "N");
    EXPECT_EQ(schema["properties"]["falcon"]["properties"]["serial"]["x-takes-effect"], "process");
    for (const auto& [key, value] : schema["properties"].items()) {
        EXPECT_FALSE(value.at("description").get<std::string>().empty()) << key;
        EXPECT_TRUE(value.at("type") == "object" || value.at("type") == "array" ||
                    value.contains("x-takes-effect"))
            << key;
    }
}

// script/report config makes both anew.
TEST(Documents, OfTheSettingsAreWhatTheProgramSaysNow) {
    EXPECT_EQ(source_text("docs/exhibit.schema.json"), exhibit_schema());
    const std::string page = source_text("docs/config.md"), heading = "## All keys\n\n";
    const std::size_t at = page.find(heading);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(page.substr(at + heading.size()), exhibit_reference());
}

TEST(Documents, OfScenesAreWhatTheProgramSaysNow) {
    EXPECT_EQ(source_text("docs/scene.md"), schema_reference());
}

}  // namespace
}  // namespace eddy
