#include "config/scene_files.h"

#include "config/scene_schema.h"

namespace eddy {
namespace {

/// The visitor that looks for file names.
class FileNames {
  public:
    template <class T>
    void value(std::string_view, T& field, std::string_view, const Range& = {}) {
        if constexpr (std::is_same_v<T, std::filesystem::path>)
            if (!field.empty()) found_.push_back(&field);
    }
    template <class T>
    void required(std::string_view key, T& field, std::string_view doc, const Range& = {}) {
        value(key, field, doc);
    }
    template <class T>
    void derived(std::string_view key, T& field, std::string_view, std::string_view doc, const Range& = {}) {
        value(key, field, doc);
    }
    template <class T>
    void conditional(std::string_view key, T& field, bool applies, std::string_view, std::string_view doc,
                     const Range& = {}) {
        if (applies) value(key, field, doc);
    }
    template <class Struct>
    void word_or_table(std::string_view, Struct& field, std::string_view) {
        describe(*this, field);
    }
    template <class Struct>
    void table(std::string_view, Struct& field, std::string_view) {
        describe(*this, field);
    }
    template <class Struct>
    void table(std::string_view, std::optional<Struct>& field, std::string_view) {
        if (field) describe(*this, *field);
    }
    template <class Enum, class Struct>
    void uniform(std::string_view, Struct& field, std::string_view) {
        describe(*this, field);
    }
    template <class Struct>
    void list(std::string_view, std::vector<Struct>& field, std::string_view) {
        for (Struct& one : field) describe(*this, one);
    }

    std::vector<std::filesystem::path*> found() const { return found_; }

  private:
    std::vector<std::filesystem::path*> found_;
};

}  // namespace

std::vector<std::filesystem::path*> files_of(Scene& scene) {
    FileNames names;
    describe(names, scene);
    return names.found();
}

}  // namespace eddy
