#include "hal/folder_watch.h"

#include <fcntl.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace eddy {
namespace {

namespace fs = std::filesystem;

// A file that was only created is empty yet: that alone is no news.
constexpr std::uint32_t kEvents = IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE |
                                  IN_CREATE | IN_DELETE_SELF | IN_MOVE_SELF;
constexpr std::uint32_t kNews = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE;
constexpr std::uint32_t kGone = IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED | IN_UNMOUNT;
constexpr int kMostLinks = 8;

std::int64_t in_ns(const timespec& t) {
    return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

}  // namespace

bool FolderWatch::is_temporary(const std::string& name) {
    if (name.starts_with("..")) return false;
    if (name.starts_with('.')) return true;
    constexpr std::string_view kEnds[] = {"~", ".tmp", ".part", ".swp"};
    return std::any_of(std::begin(kEnds), std::end(kEnds),
                       [&](std::string_view end) { return name.ends_with(end); });
}

FolderWatch::FolderWatch() : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

FolderWatch::~FolderWatch() {
    if (inotify_ >= 0) ::close(inotify_);
}

void FolderWatch::watch(std::vector<fs::path> folders) {
    for (fs::path& folder : folders) {
        folder = fs::absolute(folder).lexically_normal();
        if (!folder.has_filename()) folder = folder.parent_path();  // without the slash at its end
    }
    std::sort(folders.begin(), folders.end());
    folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
    if (folders == folders_) return;
    folders_ = std::move(folders);
    sight_ = look();
    watch_again();
}

void FolderWatch::add(const fs::path& folder, const std::string* name) {
    const int watch = ::inotify_add_watch(inotify_, folder.c_str(), kEvents | IN_ONLYDIR);
    if (watch < 0) return;
    Purpose& purpose = purposes_[watch];
    if (name)
        purpose.names.insert(*name);
    else
        purpose.files = true;
}

// Whatever on the way to a folder may be made, or turned to point elsewhere.
void FolderWatch::watch_way_to(const fs::path& path, int links) {
    std::error_code none;
    for (fs::path at = path; at.has_relative_path(); at = at.parent_path()) {
        const bool turns = fs::is_symlink(fs::symlink_status(at, none));
        if (at != path && !turns && fs::exists(at, none)) continue;
        const std::string name = at.filename().string();
        add(at.parent_path(), &name);
        if (!turns || links == kMostLinks) continue;
        const fs::path target = fs::read_symlink(at, none);
        watch_way_to((target.is_absolute() ? target : at.parent_path() / target).lexically_normal(),
                     links + 1);
    }
}

void FolderWatch::watch_again() {
    if (inotify_ < 0) return;
    std::map<int, Purpose> before;
    std::swap(before, purposes_);
    for (const fs::path& folder : folders_) {
        add(folder, nullptr);
        watch_way_to(folder, 0);
    }
    for (const auto& [watch, purpose] : before)
        if (!purposes_.contains(watch)) ::inotify_rm_watch(inotify_, watch);
}

FolderWatch::Sight FolderWatch::look() const {
    Sight sight;
    const auto see = [&sight](const fs::path& path) {
        struct stat s {};
        if (::stat(path.c_str(), &s) != 0) return;
        File file{s.st_dev, s.st_ino, static_cast<std::uint64_t>(s.st_size), in_ns(s.st_mtim),
                  in_ns(s.st_ctim)};
        // What a folder holds is looked at file by file.
        if (S_ISDIR(s.st_mode)) file = {s.st_dev, s.st_ino};
        sight[path.string()] = file;
    };
    for (const fs::path& folder : folders_) {
        see(folder);
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
            if (!is_temporary(entry->path().filename().string())) see(entry->path());
    }
    return sight;
}

void FolderWatch::read_events(Instant now, News& news, bool& again) {
    alignas(inotify_event) std::array<char, 16384> bytes;
    while (true) {
        const ssize_t count = ::read(inotify_, bytes.data(), bytes.size());
        if (count <= 0) return;
        for (ssize_t at = 0; at < count;) {
            inotify_event event;
            std::memcpy(&event, &bytes[static_cast<std::size_t>(at)], sizeof(event));
            const char* named = &bytes[static_cast<std::size_t>(at) + sizeof(event)];
            const std::string name(event.len > 0 ? named : "");
            at += static_cast<ssize_t>(sizeof(event) + event.len);

            if (event.mask & IN_Q_OVERFLOW) {
                ++counters_.overflows;
                being_written_.clear();
                news.changed = again = true;
                continue;
            }
            const auto found = purposes_.find(event.wd);
            if (found == purposes_.end()) continue;
            const Purpose& purpose = found->second;
            if (event.mask & kGone) {
                if (purpose.files && (event.mask & (IN_IGNORED | IN_MOVE_SELF))) ++counters_.lost;
                if (event.mask & IN_IGNORED) purposes_.erase(found);
                news.changed = again = true;
                continue;
            }
            if (purpose.names.contains(name) &&
                (event.mask & (IN_CREATE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE)))
                news.changed = again = true;
            if (!purpose.files || is_temporary(name)) continue;
            const std::string key = std::to_string(event.wd) + "/" + name;
            if (event.mask & IN_MODIFY) being_written_[key] = now;
            if (event.mask & kNews) {
                being_written_.erase(key);
                news.changed = true;
            }
        }
    }
}

FolderWatch::News FolderWatch::poll(Instant now) {
    News news;
    bool again = false;
    if (inotify_ >= 0) read_events(now, news, again);
    if (again) watch_again();
    for (auto writer = being_written_.begin(); writer != being_written_.end();)
        writer = now - writer->second > kWriterPatience ? being_written_.erase(writer) : std::next(writer);
    if (news.changed) {
        sight_ = look();
        next_look_ = now + kLookEvery;
    } else if (now >= next_look_) {
        next_look_ = now + kLookEvery;
        Sight sight = look();
        if (being_written_.empty() && !(sight == sight_)) {
            sight_ = std::move(sight);
            news.changed = true;
            ++counters_.seen_late;
            watch_again();
        }
    }
    news.writing = !being_written_.empty();
    return news;
}

}  // namespace eddy
