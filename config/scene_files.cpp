#include "config/scene_files.h"

#include "config/scene_schema.h"

namespace eddy {
namespace {

/// The visitor that looks for file names.
class FileNames {
  public:
    template <class T>
    void value(std::string_view key, T& field, std::string_view, const Range& = {}) {
        if constexpr (std::is_same_v<T, std::filesystem::path>)
            if (!field.empty()) found_.push_back({path_ + std::string(key), field});
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
    void word_or_table(std::string_view key, Struct& field, std::string_view) {
        inside(std::string(key), field);
    }
    template <class Struct>
    void table(std::string_view key, Struct& field, std::string_view) {
        inside(std::string(key), field);
    }
    template <class Struct>
    void table(std::string_view key, std::optional<Struct>& field, std::string_view) {
        if (field) inside(std::string(key), *field);
    }
    template <class Enum, class Struct>
    void uniform(std::string_view key, Struct& field, std::string_view) {
        inside(std::string(key), field);
    }
    template <class Struct>
    void list(std::string_view key, std::vector<Struct>& field, std::string_view) {
        for (std::size_t i = 0; i < field.size(); ++i)
            inside(std::string(key) + "." + std::to_string(i), field[i]);
    }

    std::vector<SceneFile> found() const { return found_; }

  private:
    template <class Struct>
    void inside(const std::string& step, Struct& field) {
        const std::string outside = path_;
        path_ += step + ".";
        describe(*this, field);
        path_ = outside;
    }

    std::string path_;
    std::vector<SceneFile> found_;
};

}  // namespace

std::vector<SceneFile> files_of(Scene scene) {
    FileNames names;
    describe(names, scene);
    return names.found();
}

}  // namespace eddy
