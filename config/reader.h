#pragma once
#include "config/document.h"
#include "config/nearest.h"
#include "config/takes_effect.h"
#include "config/value.h"

namespace eddy {

/// What reading leaves beside the struct.
struct Findings {
    Origins origins;
    std::vector<Diagnostic> diagnostics;

    void blame(const Place& place, std::string key, std::string message) {
        diagnostics.push_back(diagnose(place, std::move(key), std::move(message)));
    }
};

/// The visitor that fills a struct from a TOML table: describe(reader, struct) reads every key the struct
/// knows, and finish() blames the keys that are left over. A key that is absent or wrong leaves its field as
/// it was.
///
/// All visitors of a describe() have these members; `doc` and `range` serve the reference, the range is
/// checked here:
///   value      a key that may be absent
///   required   a key that must be there
///   derived    a key whose default follows from other keys, by the rule given in words
///   conditional  a key that is there only when other keys say so (`applies`, and the rule in words); that
///                it is there when it should be, and only then, is up to the checks after reading
///   table      a struct under [key]; when the field is std::optional, only if the table is there
///   word_or_table  a struct whose key `kind` is a word: a table, or that word alone
///   uniform    a struct of word_or_tables: a table, or one word that stands for all
///   list       structs under [[key]]
///   takes_effect  when new values of the keys that follow count, those of tables among them too; an exhibit's only
class Reader {
  public:
    Reader(const Node& table, std::string path, Findings& findings)
        : table_(table), path_(std::move(path)), findings_(findings) {
        findings_.origins[path_] = table.place;
    }

    template <class T>
    void value(std::string_view key, T& field, std::string_view /*doc*/, const Range& range = {}) {
        if (const Node* node = take(key)) {
            findings_.origins[path_to(key)] = node->place;
            read(*node, path_to(key), field, range);
        }
    }

    template <class T>
    void required(std::string_view key, T& field, std::string_view doc, const Range& range = {}) {
        value(key, field, doc, range);
        if (!table_.find(key))
            findings_.blame(table_.place, path_to(key),
                            fmt::format("is missing here: write {} = {}", key, type_name(field)));
    }

    template <class T>
    void derived(std::string_view key, T& field, std::string_view /*rule*/, std::string_view doc,
                 const Range& range = {}) {
        value(key, field, doc, range);
    }

    template <class T>
    void conditional(std::string_view key, T& field, bool /*applies*/, std::string_view /*rule*/,
                     std::string_view doc, const Range& range = {}) {
        value(key, field, doc, range);
    }

    void takes_effect(TakesEffect) {}

    template <class Struct>
    void table(std::string_view key, Struct& field, std::string_view /*doc*/) {
        if (const Node* node = take(key)) read_table(*node, path_to(key), field);
    }

    template <class Struct>
    void table(std::string_view key, std::optional<Struct>& field, std::string_view /*doc*/) {
        if (const Node* node = take(key))
            read_table(*node, path_to(key), field.emplace(Struct{}));  // clang 14 refuses emplace()
    }

    template <class Struct>
    void word_or_table(std::string_view key, Struct& field, std::string_view /*doc*/) {
        const Node* node = take(key);
        if (!node) return;
        findings_.origins[path_to(key)] = node->place;
        if (node->kind == Node::Kind::Table) return read_table(*node, path_to(key), field);
        if (node->kind == Node::Kind::Text)
            read(*node, path_to(key), field.kind, {});
        else
            wrong_type(
                *node, path_to(key),
                fmt::format("a table, or one of the words {}", listed(all_words<decltype(field.kind)>())));
    }

    template <class Enum, class Struct>
    void uniform(std::string_view key, Struct& field, std::string_view doc) {
        const Node* node = take(key);
        if (!node) return;
        if (node->kind == Node::Kind::Table) return table(key, field, doc);
        if (Enum all{}; !read(*node, path_to(key), all, {})) return;
        Reader reader(*node, path_to(key), findings_);
        reader.stands_for_all_ = true;
        describe(reader, field);
    }

    template <class Struct>
    void list(std::string_view key, std::vector<Struct>& field, std::string_view /*doc*/) {
        const Node* node = take(key);
        if (!node || !is_list_of_tables(*node, key)) return;
        for (std::size_t i = 0; i < node->children.size(); ++i)
            read_table(node->children[i], path_to(key) + "." + std::to_string(i), field.emplace_back());
    }

    /// Blames each key of the table that describe() did not name.
    void finish();

  private:
    const Node* take(std::string_view key);
    std::string path_to(std::string_view key) const;
    bool is_list_of_tables(const Node& node, std::string_view key);
    void wrong_type(const Node& node, const std::string& path, std::string_view expected);
    void wrong_word(const Node& node, const std::string& path, const std::vector<std::string_view>& words);

    template <class Struct>
    void read_table(const Node& node, const std::string& path, Struct& field) {
        if (node.kind != Node::Kind::Table) return wrong_type(node, path, "a table");
        Reader reader(node, path, findings_);
        describe(reader, field);
        reader.finish();
    }

    // Each of these returns false, with the blame laid, when the node does not fit.
    bool read(const Node& node, const std::string& path, bool& field, const Range& range);
    bool read(const Node& node, const std::string& path, int& field, const Range& range);
    bool read(const Node& node, const std::string& path, double& field, const Range& range);
    bool read(const Node& node, const std::string& path, glm::ivec3& field, const Range& range);
    bool read(const Node& node, const std::string& path, glm::dvec3& field, const Range& range);
    bool read(const Node& node, const std::string& path, Formula& field, const Range& range);
    bool read(const Node& node, const std::string& path, FormulaVector& field, const Range& range);
    bool read(const Node& node, const std::string& path, std::string& field, const Range& range);
    bool read(const Node& node, const std::string& path, std::filesystem::path& field, const Range& range);

    // Three components in a list; the field changes only if all are good.
    template <class Vector>
    bool read_vector(const Node& node, const std::string& path, Vector& field, const Range& range) {
        if (node.kind != Node::Kind::List || node.children.size() != 3) {
            wrong_type(node, path, type_name(field));
            return false;
        }
        Vector v = field;
        const bool x = read(node.children[0], path + ".0", v.x, range);
        const bool y = read(node.children[1], path + ".1", v.y, range);
        const bool z = read(node.children[2], path + ".2", v.z, range);
        if (x && y && z) field = v;
        return x && y && z;
    }

    template <class T>
    bool read(const Node& node, const std::string& path, std::optional<T>& field, const Range& range) {
        T found{};
        if (!read(node, path, found, range)) return false;
        field = found;
        return true;
    }

    template <Worded Enum>
    bool read(const Node& node, const std::string& path, Enum& field, const Range&) {
        if (node.kind != Node::Kind::Text) {
            wrong_type(node, path, fmt::format("one of the words {}", listed(all_words<Enum>())));
            return false;
        }
        if (const std::optional<Enum> found = from_word<Enum>(node.text)) {
            field = *found;
            return true;
        }
        wrong_word(node, path, all_words<Enum>());
        return false;
    }

    template <Worded Enum>
    bool read(const Node& node, const std::string& path, std::vector<Enum>& field, const Range& range) {
        if (node.kind != Node::Kind::List) {
            wrong_type(node, path, fmt::format("a list of the words {}", listed(all_words<Enum>())));
            return false;
        }
        std::vector<Enum> found(node.children.size());
        bool good = true;
        for (std::size_t i = 0; i < found.size(); ++i)
            good = read(node.children[i], path + "." + std::to_string(i), found[i], range) && good;
        if (good) field = found;
        return good;
    }

    const Node& table_;
    const std::string path_;
    Findings& findings_;
    bool stands_for_all_ = false;         // table_ is no table but the value of each key (see uniform)
    std::vector<std::string_view> keys_;  // every key describe() named, for finish()
};

/// Reads a whole document into a struct.
template <class Struct>
void read_document(const Node& root, Struct& field, Findings& findings) {
    Reader reader(root, "", findings);
    describe(reader, field);
    reader.finish();
}

}  // namespace eddy
