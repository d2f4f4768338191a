#pragma once
#include <memory>

#include "config/takes_effect.h"
#include "config/value.h"

namespace eddy {

/// The visitor that writes a JSON Schema (2020-12), for editors that complete and check what is typed. It describes a struct
/// as its constructor leaves it.
class JsonSchema {
  public:
    /// Keys that do not say when they take effect do so when the program starts again.
    explicit JsonSchema(TakesEffect takes_effect = TakesEffect::Process);
    ~JsonSchema();
    JsonSchema(JsonSchema&&) noexcept;

    void takes_effect(TakesEffect when) { takes_effect_ = when; }

    template <class T>
    void value(std::string_view key, const T& field, std::string_view doc, const Range& range = {}) {
        add(key, kind<T>(range), doc, json_of(field));
    }
    template <class T>
    void value(std::string_view key, const std::optional<T>&, std::string_view doc, const Range& range = {}) {
        add(key, kind<T>(range), doc, "");
    }
    template <class T>
    void required(std::string_view key, const T&, std::string_view doc, const Range& range = {}) {
        add(key, kind<T>(range), doc, "");
        require(key);
    }
    template <class T>
    void derived(std::string_view key, const T&, std::string_view /*rule*/, std::string_view doc,
                 const Range& range = {}) {
        add(key, kind<T>(range), doc, "");
    }
    template <class T>
    void conditional(std::string_view key, const T&, bool /*applies*/, std::string_view /*rule*/,
                     std::string_view doc, const Range& range = {}) {
        add(key, kind<T>(range), doc, "");
    }
    template <class Struct>
    void table(std::string_view key, Struct& field, std::string_view doc) {
        JsonSchema inside(takes_effect_);
        describe(inside, field);
        add_table(key, inside, doc, false);
    }
    template <class Struct>
    void table(std::string_view key, std::optional<Struct>&, std::string_view doc) {
        Struct field{};
        table(key, field, doc);
    }
    template <class Struct>
    void list(std::string_view key, std::vector<Struct>&, std::string_view doc) {
        JsonSchema inside(takes_effect_);
        Struct field{};
        describe(inside, field);
        add_table(key, inside, doc, true);
    }

    std::string text(const std::string& title) const;

  private:
    /// What may stand under a key.
    struct Kind {
        const char* type = "string";
        bool list = false;  ///< of that
        int length = 0;     ///< of a list; 0: any
        std::vector<std::string_view> words{};
        std::string word_docs{};
        Range range{};
    };

    template <class T>
    static Kind kind(const Range& range) {
        Kind kind;
        kind.range = range;
        if constexpr (std::is_same_v<T, bool>) {
            kind.type = "boolean";
        } else if constexpr (std::is_same_v<T, int>) {
            kind.type = "integer";
        } else if constexpr (std::is_same_v<T, double>) {
            kind.type = "number";
        } else if constexpr (Worded<T>) {
            kind.words = all_words<T>();
            for (const Word<T>& w : words_of(T{}))
                kind.word_docs += fmt::format("{}{}: {}", kind.word_docs.empty() ? "" : "; ", w.word, w.doc);
        } else if constexpr (std::is_same_v<T, glm::ivec3> || std::is_same_v<T, glm::dvec3>) {
            kind.type = std::is_same_v<T, glm::ivec3> ? "integer" : "number";
            kind.list = true;
            kind.length = 3;
        } else if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, std::filesystem::path>) {
            kind = JsonSchema::kind<typename T::value_type>(range);
            kind.list = true;
        }
        return kind;
    }

    // What is written in TOML for numbers, truth values, words, texts and lists of them is JSON too.
    template <class T>
    static std::string json_of(const T& field) {
        return to_toml(field);
    }

    void add(std::string_view key, const Kind& kind, std::string_view doc, const std::string& otherwise);
    void add_table(std::string_view key, const JsonSchema& inside, std::string_view doc, bool list);
    void require(std::string_view key);

    struct Object;
    std::unique_ptr<Object> object_;  // what it is written with stays in json_schema.cpp
    TakesEffect takes_effect_;
};

}  // namespace eddy
