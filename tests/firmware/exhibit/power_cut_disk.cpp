#include "tests/firmware/exhibit/power_cut_disk.h"

#include <algorithm>

#include "tests/scratch_folder.h"

namespace eddy {

namespace fs = std::filesystem;

PowerCutDisk::PowerCutDisk(fs::path root) : root_(std::move(root)) {
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
        if (!entry.is_regular_file()) continue;
        const std::string name = name_of(entry.path());
        start_[name] = {files_, read_all(entry.path())};
        names_[name] = files_++;
    }
}

std::string PowerCutDisk::name_of(const fs::path& path) const {
    return path.lexically_relative(root_).string();
}

int PowerCutDisk::file_at(const std::string& name) {
    if (const auto found = names_.find(name); found != names_.end()) return found->second;
    names_[name] = files_;
    log_.push_back({Operation::Kind::Name, files_, name});
    return files_++;
}

void PowerCutDisk::log_bytes(const fs::path& path, std::string bytes) {
    const int file = file_at(name_of(path));
    log_.push_back({Operation::Kind::Bytes, file, "", std::move(bytes)});
}

void PowerCutDisk::write(const fs::path& file, std::string_view bytes) {
    real_disk().write(file, bytes);
    log_bytes(file, "");
    log_bytes(file, std::string(bytes));
    log_.push_back({Operation::Kind::Flush, file_at(name_of(file))});
}

void PowerCutDisk::rename(const fs::path& from, const fs::path& to) {
    real_disk().rename(from, to);
    const int file = file_at(name_of(from));
    names_.erase(name_of(from));
    names_[name_of(to)] = file;
    log_.push_back({Operation::Kind::Name, file, name_of(to)});
    log_.push_back({Operation::Kind::Name, -1, name_of(from)});
}

void PowerCutDisk::remove(const fs::path& file) {
    real_disk().remove(file);
    if (names_.erase(name_of(file)) > 0) log_.push_back({Operation::Kind::Name, -1, name_of(file)});
}

void PowerCutDisk::make_folder(const fs::path& folder) {
    real_disk().make_folder(folder);  // its files are lost with it: as if their own names were
}

void PowerCutDisk::flush_folder(const fs::path& folder) {
    real_disk().flush_folder(folder);
    log_.push_back({Operation::Kind::FlushFolder, -1, name_of(folder)});
}

void PowerCutDisk::write_in_place(const fs::path& file, const std::string& bytes, std::size_t piece) {
    real_disk().write(file, bytes);
    log_bytes(file, "");
    for (std::size_t length = piece; length < bytes.size(); length += piece)
        log_bytes(file, bytes.substr(0, length));
    log_bytes(file, bytes);
}

void PowerCutDisk::replace_unflushed(const fs::path& file, const std::string& bytes) {
    const fs::path beside = file.parent_path() / ("." + file.filename().string() + ".Ab12Cd");
    write_in_place(beside, bytes, bytes.size());
    rename(beside, file);
}

void PowerCutDisk::flush_everything() {
    log_.push_back({Operation::Kind::Sync});
}

std::map<std::string, std::string> PowerCutDisk::after_cut(std::size_t cut, std::mt19937_64& random) const {
    // For each file and each name what the disk surely has, and what it may have instead.
    struct Bytes {
        std::string sure;
        std::vector<std::string> maybe{};
    };
    struct Name {
        int sure = -1;
        std::vector<int> maybe{};
    };
    std::map<int, Bytes> files;
    std::map<std::string, Name> names;
    for (const auto& [name, first] : start_) {
        names[name].sure = first.number;
        files[first.number].sure = first.bytes;
    }
    const auto settle = [](auto& one) {
        if (!one.maybe.empty()) one.sure = one.maybe.back();
        one.maybe.clear();
    };
    for (std::size_t i = 0; i < cut; ++i) {
        const Operation& operation = log_[i];
        switch (operation.kind) {
            case Operation::Kind::Bytes:
                files[operation.file].maybe.push_back(operation.bytes);
                break;
            case Operation::Kind::Flush:
                settle(files[operation.file]);
                break;
            case Operation::Kind::Name:
                names[operation.path].maybe.push_back(operation.file);
                break;
            case Operation::Kind::FlushFolder:
                for (auto& [name, one] : names)
                    if (fs::path(name).parent_path() == (operation.path == "." ? "" : operation.path))
                        settle(one);
                break;
            case Operation::Kind::Sync:
                for (auto& [number, one] : files) settle(one);
                for (auto& [name, one] : names) settle(one);
        }
    }
    const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    std::map<int, std::string> bytes_of;
    for (auto& [number, one] : files) {
        std::string bytes = one.sure;
        if (const std::size_t pick = below(one.maybe.size() + 1); pick > 0) {
            const std::string& before = pick > 1 ? one.maybe[pick - 2] : one.sure;
            bytes = one.maybe[pick - 1];
            const std::size_t length = below(bytes.size() + 1);
            switch (below(4)) {
                case 0:
                    bytes.resize(length);
                    break;
                case 1:
                    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(length), bytes.end(), '\0');
                    break;
                case 2:  // some of the old bytes
                    if (length < before.size())
                        bytes.replace(length, std::string::npos, before.substr(length));
                    break;
                default:
                    break;
            }
        }
        bytes_of[number] = bytes;
    }
    std::map<std::string, std::string> disk;
    for (const auto& [name, one] : names) {
        const std::size_t pick = below(one.maybe.size() + 1);
        const int number = pick > 0 ? one.maybe[pick - 1] : one.sure;
        if (number >= 0) disk[name] = bytes_of[number];
    }
    return disk;
}

}  // namespace eddy
