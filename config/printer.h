#pragma once
#include "config/takes_effect.h"

namespace eddy {

/// The visitor that writes a struct as TOML: everything, defaults included. With `origins`, each value is
/// followed by a comment that says where it came from: "file:line:column" or "default".
class Printer {
  public:
    explicit Printer(const Origins* origins) : origins_(origins) {}

    template <class T>
    void value(std::string_view key, const T& field, std::string_view /*doc*/, const Range& = {}) {
        line(key, to_toml(field));
    }
    template <class T>
    void value(std::string_view key, const std::optional<T>& field, std::string_view /*doc*/,
               const Range& = {}) {
        if (field) line(key, to_toml(*field));
    }
    // An absent file name is an empty path, which TOML could not read back as a file name.
    void value(std::string_view key, const std::filesystem::path& field, std::string_view /*doc*/,
               const Range& = {}) {
        if (!field.empty()) line(key, to_toml(field));
    }
    template <class T>
    void required(std::string_view key, const T& field, std::string_view doc, const Range& range = {}) {
        value(key, field, doc, range);
    }
    template <class T>
    void derived(std::string_view key, const T& field, std::string_view /*rule*/, std::string_view doc,
                 const Range& range = {}) {
        value(key, field, doc, range);
    }
    template <class T>
    void conditional(std::string_view key, const T& field, bool applies, std::string_view /*rule*/,
                     std::string_view doc, const Range& range = {}) {
        if (applies) value(key, field, doc, range);
    }
    void takes_effect(TakesEffect) {}

    template <class Struct>
    void word_or_table(std::string_view key, Struct& field, std::string_view doc) {
        Struct word_alone{};
        word_alone.kind = field.kind;
        if (field == word_alone)
            value(key, field.kind, doc);
        else
            table(key, field, doc);
    }
    template <class Struct>
    void table(std::string_view key, Struct& field, std::string_view /*doc*/) {
        nested(std::string(key), key, "[", "]", field);
    }
    template <class Struct>
    void table(std::string_view key, std::optional<Struct>& field, std::string_view doc) {
        if (field) table(key, *field, doc);
    }
    template <class Enum, class Struct>
    void uniform(std::string_view key, Struct& field, std::string_view doc) {
        table(key, field, doc);
    }
    template <class Struct>
    void list(std::string_view key, std::vector<Struct>& field, std::string_view /*doc*/) {
        for (std::size_t i = 0; i < field.size(); ++i)
            nested(fmt::format("{}.{}", key, i), key, "[[", "]]", field[i]);
    }

    /// What was written so far: the values of this table, then the tables inside it.
    std::string text() const { return values_ + tables_; }

  private:
    void line(std::string_view key, const std::string& value) {
        values_ += fmt::format("{} = {}", key, value);
        if (origins_) values_ += fmt::format("  # {}", origin(fmt::format("{}{}", path_, key)));
        values_ += '\n';
    }

    std::string origin(const std::string& path) const {
        const auto found = origins_->find(path);
        return found == origins_->end() ? "default" : to_string(found->second);
    }

    template <class Struct>
    void nested(const std::string& step, std::string_view key, const char* open, const char* close,
                Struct& field) {
        Printer inside(origins_);
        inside.path_ = fmt::format("{}{}.", path_, step);
        inside.header_ = fmt::format("{}{}.", header_, key);
        describe(inside, field);
        tables_ += fmt::format("\n{}{}{}{}\n{}", open, header_, key, close, inside.text());
    }

    const Origins* origins_;
    std::string path_;    // "body.0." inside the first [[body]]
    std::string header_;  // "body."
    std::string values_;
    std::string tables_;
};

}  // namespace eddy
