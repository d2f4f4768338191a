#pragma once
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "firmware/disk.h"

namespace eddy {

/// The real disk, and a model beside it of what a power cut would leave, kept as harshly as POSIX allows: a name counts only
/// when its folder was flushed, until then each name alone may be there or not; bytes count only when they were flushed, until
/// then the file may hold what it held before, nothing, a piece, or noughts in place of the rest.
class PowerCutDisk final : public Disk {
  public:
    /// Everything below `root` is on the disk.
    explicit PowerCutDisk(std::filesystem::path root);

    void write(const std::filesystem::path& file, std::string_view bytes) override;
    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override;
    void remove(const std::filesystem::path& file) override;
    void make_folder(const std::filesystem::path& folder) override;
    void flush_folder(const std::filesystem::path& folder) override;

    /// As others write, who flush nothing: piece by piece into the file itself ...
    void write_in_place(const std::filesystem::path& file, const std::string& bytes, std::size_t piece);
    /// ... or beside it, and renamed.
    void replace_unflushed(const std::filesystem::path& file, const std::string& bytes);
    /// What the kernel does by itself after half a minute.
    void flush_everything();

    /// Operations so far: the power can be cut after each, and, as bytes that are not flushed may be there in part, within each.
    std::size_t operations() const { return log_.size(); }

    /// What is on the disk, path below root to bytes, had the power been cut there; chance decides what is open.
    std::map<std::string, std::string> after_cut(std::size_t cut, std::mt19937_64& random) const;

  private:
    struct Operation {
        enum class Kind { Bytes, Flush, Name, FlushFolder, Sync } kind;
        int file = -1;        // Bytes, Flush, Name (-1: no file any more)
        std::string path{};   // Name, FlushFolder
        std::string bytes{};  // Bytes: all that the file holds from then on
    };

    std::string name_of(const std::filesystem::path& path) const;
    int file_at(const std::string& name);
    void log_bytes(const std::filesystem::path& path, std::string bytes);

    std::filesystem::path root_;
    struct File {
        int number = 0;
        std::string bytes;
    };
    std::map<std::string, File> start_;
    std::vector<Operation> log_;
    std::map<std::string, int> names_;  // as the running system sees them
    int files_ = 0;
};

}  // namespace eddy
