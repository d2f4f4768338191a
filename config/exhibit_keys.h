#pragma once
#include <functional>
#include <string>
#include <vector>

#include "config/exhibit.h"

namespace eddy {

/// The visitor that holds two structs of the same kind against each other, key by key. A list of tables, and a table that may
/// be absent, is one key. The structs must outlive it.
class ExhibitKeys {
  public:
    /// Keys that do not say when they take effect do so when the program starts again.
    explicit ExhibitKeys(TakesEffect takes_effect = TakesEffect::Process) : takes_effect_(takes_effect) {}

    void takes_effect(TakesEffect when) { takes_effect_ = when; }

    template <class T>
    void value(std::string_view key, T& field, std::string_view /*doc*/, const Range& = {}) {
        add(key, field, to_toml(field));
    }
    template <class T>
    void value(std::string_view key, std::optional<T>& field, std::string_view /*doc*/, const Range& = {}) {
        add(key, field, field ? to_toml(*field) : "");
    }
    template <class T>
    void required(std::string_view key, T& field, std::string_view doc, const Range& range = {}) {
        value(key, field, doc, range);
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
    template <class Struct>
    void table(std::string_view key, Struct& field, std::string_view /*doc*/) {
        ExhibitKeys inside(takes_effect_);
        inside.path_ = path_ + std::string(key) + ".";
        describe(inside, field);
        keys_.insert(keys_.end(), inside.keys_.begin(), inside.keys_.end());
    }
    template <class Struct>
    void table(std::string_view key, std::optional<Struct>& field, std::string_view /*doc*/) {
        add(key, field, field ? "1" : "0");
    }
    template <class Struct>
    void list(std::string_view key, std::vector<Struct>& field, std::string_view /*doc*/) {
        add(key, field, std::to_string(field.size()));
    }

    bool has(std::string_view path) const;
    bool has_inside(std::string_view table) const;

    std::vector<KeyChange> changes_since(const ExhibitKeys& before) const;

    /// Gives the keys for which `kept` says so the values that they had in `before`.
    void keep(const ExhibitKeys& before, const std::function<bool(TakesEffect)>& kept) const;

  private:
    struct Key {
        std::string path;
        TakesEffect takes_effect;
        std::string toml;
        void* field;
        bool (*same)(const void*, const void*);
        void (*copy)(void* to, const void* from);
    };

    template <class T>
    void add(std::string_view key, T& field, std::string toml) {
        keys_.push_back(
            {path_ + std::string(key), takes_effect_, std::move(toml), &field,
             [](const void* a, const void* b) {
                 return *static_cast<const T*>(a) == *static_cast<const T*>(b);
             },
             [](void* to, const void* from) { *static_cast<T*>(to) = *static_cast<const T*>(from); }});
    }

    TakesEffect takes_effect_;
    std::string path_;
    std::vector<Key> keys_;
};

}  // namespace eddy
