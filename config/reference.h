#pragma once
#include <utility>

#include "config/takes_effect.h"
#include "config/value.h"

namespace eddy {

/// The visitor that writes the reference: one markdown table for each table of the schema, with each key's
/// type, range, default and meaning. It describes a struct as its constructor leaves it. `Keys::OfExhibit` have two columns
/// more: the unit, and when a new value takes effect.
class Reference {
  public:
    enum class Keys { OfScene, OfExhibit };

    /// Keys that do not say when they take effect do so when the program starts again.
    explicit Reference(Keys keys = Keys::OfScene, TakesEffect takes_effect = TakesEffect::Process)
        : keys_(keys), takes_effect_(takes_effect) {}

    void takes_effect(TakesEffect when) { takes_effect_ = when; }

    template <class T>
    void value(std::string_view key, const T& field, std::string_view doc, const Range& range = {}) {
        row<T>(key, range, code(to_toml(field)), doc);
    }
    template <class T>
    void value(std::string_view key, const std::optional<T>&, std::string_view doc, const Range& range = {}) {
        row<T>(key, range, "", doc);
    }
    void value(std::string_view key, const std::filesystem::path& field, std::string_view doc,
               const Range& range = {}) {
        row<std::filesystem::path>(key, range, field.empty() ? "" : code(to_toml(field)), doc);
    }
    template <class T>
    void required(std::string_view key, const T&, std::string_view doc, const Range& range = {}) {
        row<T>(key, range, "must be given", doc);
    }
    template <class T>
    void derived(std::string_view key, const T&, std::string_view rule, std::string_view doc,
                 const Range& range = {}) {
        row<T>(key, range, rule, doc);
    }
    template <class T>
    void conditional(std::string_view key, const T&, bool /*applies*/, std::string_view rule,
                     std::string_view doc, const Range& range = {}) {
        row<T>(key, range, rule, doc);
    }
    template <class Struct>
    void word_or_table(std::string_view key, Struct& field, std::string_view doc) {
        add_row(key, "a word or a table", "", code(to_toml(field.kind)), doc, "");
        // The first of its kind is described in full.
        if (std::exchange(described_, true)) return;
        nested(
            key, "[", "]",
            fmt::format("A table in place of the word, shown for `{}`; the keys beside it can hold the same.",
                        key),
            field);
    }
    template <class Struct>
    void table(std::string_view key, Struct& field, std::string_view doc) {
        nested(key, "[", "]", doc, field);
    }
    template <class Struct>
    void table(std::string_view key, std::optional<Struct>&, std::string_view doc) {
        Struct field{};
        nested(key, "[", "]", fmt::format("{} Absent unless the table is written.", doc), field);
    }
    template <class Enum, class Struct>
    void uniform(std::string_view key, Struct& field, std::string_view doc) {
        nested(key, "[", "]", fmt::format("{} One word in place of the table stands for all its keys.", doc),
               field);
    }
    template <class Struct>
    void list(std::string_view key, std::vector<Struct>&, std::string_view doc) {
        Struct field{};
        nested(key, "[[", "]]", fmt::format("{} Any number of them.", doc), field);
    }

    /// What was written so far: the keys of this table, then the tables inside it.
    std::string text() const;

  private:
    static std::string code(const std::string& text) { return fmt::format("`{}`", text); }

    template <class T>
    void row(std::string_view key, const Range& range, std::string_view otherwise, std::string_view doc) {
        add_row(key, type_name(T{}), to_string(range), otherwise, doc, words<T>());
    }

    void add_row(std::string_view key, std::string_view type, const std::string& range,
                 std::string_view otherwise, std::string_view doc, const std::string& words);

    // "`word` what it stands for; ..." for enumerations and lists of them, empty for the rest.
    template <class T>
    static std::string words() {
        if constexpr (Worded<T>) {
            std::string out;
            for (const Word<T>& w : words_of(T{}))
                out += fmt::format("{}`{}`{}{}", out.empty() ? "" : "; ", w.word, w.doc.empty() ? "" : " ",
                                   w.doc);
            return out;
        } else if constexpr (requires { requires Worded<typename T::value_type>; }) {
            return words<typename T::value_type>();
        } else {
            return "";
        }
    }

    template <class Struct>
    void nested(std::string_view key, const char* open, const char* close, std::string_view doc,
                Struct& field) {
        Reference inside(keys_, takes_effect_);
        inside.header_ = fmt::format("{}{}.", header_, key);
        describe(inside, field);
        tables_ += fmt::format("\n## `{}{}{}{}`\n\n{}\n\n{}", open, header_, key, close, doc, inside.text());
    }

    Keys keys_;
    TakesEffect takes_effect_;
    bool described_ = false;  // a word_or_table
    std::string header_;
    std::string rows_;
    std::string tables_;
};

}  // namespace eddy
