#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal/clock.h"

namespace eddy {

/// Notices that files in some folders were written, whoever writes them: in place, or beside them and renamed; also when the
/// folder is a symbolic link that is turned, comes only later, or lies where the kernel tells nothing (network, USB): it is
/// looked at every five seconds. One thread; nothing waits. Without inotify the looks alone remain.
class FolderWatch {
  public:
    struct News {
        bool changed = false;  ///< something may be another since the last poll
        bool writing = false;  ///< somebody writes into a file
    };
    struct Counters {
        std::uint64_t overflows = 0;  ///< more happened than the kernel kept
        std::uint64_t lost = 0;       ///< a folder went, or was unmounted
        std::uint64_t seen_late = 0;  ///< changes that only a look found
    };

    static constexpr Instant kLookEvery = std::chrono::seconds(5);
    /// A writer that says nothing for so long is not waited for.
    static constexpr Instant kWriterPatience = std::chrono::seconds(30);

    FolderWatch();
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    /// Watches these from now on, and no others. They need not exist.
    void watch(std::vector<std::filesystem::path> folders);

    News poll(Instant now);

    const Counters& counters() const { return counters_; }

    /// Names that writers use while they write: .name, name~, .tmp, .part, .swp; but ..data, which is what turns in a folder of
    /// links.
    static bool is_temporary(const std::string& name);

  private:
    /// What a watch is for: the files in it, or names that lead to a folder that is watched.
    struct Purpose {
        bool files = false;
        std::set<std::string> names{};
    };
    struct File {
        std::uint64_t device = 0, inode = 0, size = 0;
        std::int64_t written_ns = 0, changed_ns = 0;
        bool operator==(const File&) const = default;
    };
    using Sight = std::map<std::string, File>;  // path -> file

    void watch_again();
    void add(const std::filesystem::path& folder, const std::string* name);
    void watch_way_to(const std::filesystem::path& path, int links);
    Sight look() const;
    void read_events(Instant now, News& news, bool& again);

    int inotify_ = -1;
    std::vector<std::filesystem::path> folders_;
    std::map<int, Purpose> purposes_;               // by watch descriptor
    std::map<std::string, Instant> being_written_;  // descriptor/name -> last seen
    Sight sight_;
    Instant next_look_{0};
    Counters counters_;
};

}  // namespace eddy
