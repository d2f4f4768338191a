#include "firmware/exhibit/config_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "config/sha256.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::vector<WrittenFile>& files) {
    Json j = Json::array();
    for (const WrittenFile& file : files) j.push_back({{"path", file.path.string()}, {"text", file.text}});
    return j;
}

std::vector<WrittenFile> files_of(const Json& j) {
    std::vector<WrittenFile> files;
    for (const Json& one : j)
        files.push_back({one.at("path").get<std::string>(), one.at("text").get<std::string>()});
    return files;
}

/// What a file is called among the copies: what reads a mesh goes by the end of its name.
std::string copy_name(const WrittenFile& file) {
    return sha256(file.text) + file.path.extension().string();
}

}  // namespace

ConfigMemory::ConfigMemory(std::filesystem::path folder, std::string boot, std::string program, Disk& disk)
    : folder_(std::move(folder)),
      boot_(std::move(boot)),
      program_(std::move(program)),
      disk_(disk),
      last_good_(folder_ / "last-good", disk),
      probation_(folder_ / "probation", disk),
      black_list_(folder_ / "black-list", disk) {}

template <class Action>
void ConfigMemory::attempt(Action action) {
    if (folder_.empty()) return;
    try {
        action();
    } catch (const std::exception& error) {
        ++failed_writes_;
        trouble_ = error.what();
    }
}

std::optional<std::string> ConfigMemory::judge() {
    if (folder_.empty()) return std::nullopt;
    try {
        if (const auto text = black_list_.read())
            for (const Json& one : Json::parse(*text))
                black_listed_.push_back(one.is_string() ? Death{one.get<std::string>(), ""}
                                                        : Death{one.at("hash").get<std::string>(),
                                                                one.at("program").get<std::string>()});
    } catch (const std::exception&) {
        ++unreadable_;
    }
    const auto text = probation_.read();
    if (!text) return std::nullopt;
    try {
        const Json j = Json::parse(*text);
        const std::string hash = j.at("hash"), boot = j.at("boot");
        // Under another program than this: that proves nothing against this one. Written before programs were told apart: so, too.
        if (j.value("program", "") != program_) {
            end_probation();
            return std::nullopt;
        }
        on_probation_ = hash;
        cuts_ = j.at("cuts").get<int>() + 1;
        if (boot != boot_ && cuts_ < kMostCuts) {
            write_probation();
            return std::nullopt;
        }
        black_list(hash);
        end_probation();
        return hash;
    } catch (const std::exception&) {
        ++unreadable_;
        return std::nullopt;
    }
}

std::optional<ConfigSet> ConfigMemory::last_good(const SceneOrders& orders) {
    if (folder_.empty()) return std::nullopt;
    const auto text = last_good_.read();
    had_last_good_ = text || last_good_.unreadable() > 0;
    if (!text) return std::nullopt;
    try {
        const Json j = Json::parse(*text);
        ConfigFiles files;
        files.exhibit.folder = j.at("folder").get<std::string>();
        files.exhibit.own = files_of(j.at("own"));
        files.exhibit.drop_ins = files_of(j.at("drop_ins"));
        files.exhibit.sums = files_of(j.at("sums"));
        files.scene = files_of(j.at("scene"));
        std::vector<std::filesystem::path> copies;
        for (const Json& one : j.at("refers")) {
            const std::string path = one.at("path"), copy = one.at("copy");
            const std::string bytes = read_text_file(folder_ / "files" / copy);
            if (copy != copy_name({path, bytes})) throw std::runtime_error("a copy is another");
            files.refers.push_back({path, bytes});
            files.keys.push_back(one.at("key"));
            copies.push_back(folder_ / "files" / copy);
        }
        ConfigSet set = config_set_of(files, orders, copies);
        if (!set.good()) return std::nullopt;  // it was, to another version of the program
        last_good_hash_ = set.hash;
        return set;
    } catch (const std::exception&) {
        ++unreadable_;
        return std::nullopt;
    }
}

void ConfigMemory::keep_as_last_good(const ConfigSet& set) {
    attempt([&] {
        const std::filesystem::path copies = folder_ / "files";
        Json refers = Json::array();
        std::set<std::string> wanted;
        for (std::size_t i = 0; i < set.files.refers.size(); ++i) {
            const WrittenFile& file = set.files.refers[i];
            const std::string copy = copy_name(file);
            refers.push_back({{"key", set.files.keys[i]}, {"path", file.path.string()}, {"copy", copy}});
            wanted.insert(copy);
            if (std::filesystem::exists(copies / copy) && read_text_file(copies / copy) == file.text)
                continue;
            if (!is_folder(copies)) {
                disk_.make_folder(copies);
                disk_.flush_folder(folder_);
                disk_.flush_folder(folder_.parent_path());
            }
            replace_text_file(copies / copy, file.text, disk_);
        }
        const Json j{{"hash", set.hash},
                     {"folder", set.files.exhibit.folder.string()},
                     {"own", json_of(set.files.exhibit.own)},
                     {"drop_ins", json_of(set.files.exhibit.drop_ins)},
                     {"sums", json_of(set.files.exhibit.sums)},
                     {"scene", json_of(set.files.scene)},
                     {"refers", refers}};
        last_good_.write(j.dump(1) + "\n");
        last_good_hash_ = set.hash;
        // Copies that nothing names any more.
        std::error_code none;
        for (std::filesystem::directory_iterator entry(copies, none), end; !none && entry != end;
             entry.increment(none))
            if (!wanted.contains(entry->path().filename().string())) disk_.remove(entry->path());
    });
}

void ConfigMemory::begin_probation(const std::string& hash) {
    if (hash != on_probation_) cuts_ = 0;
    on_probation_ = hash;
    write_probation();
}

void ConfigMemory::write_probation() {
    const Json j{{"hash", on_probation_}, {"program", program_}, {"boot", boot_}, {"cuts", cuts_}};
    attempt([&] { probation_.write(j.dump()); });
}

void ConfigMemory::end_probation() {
    on_probation_.clear();
    cuts_ = 0;
    attempt([&] { probation_.remove(); });
}

bool ConfigMemory::black_listed(const std::string& hash) const {
    return std::find(black_listed_.begin(), black_listed_.end(), Death{hash, program_}) !=
           black_listed_.end();
}

void ConfigMemory::black_list(const std::string& hash) {
    if (black_listed(hash)) return;
    black_listed_.push_back({hash, program_});
    if (black_listed_.size() > kMostBlackListed) black_listed_.erase(black_listed_.begin());
    Json list = Json::array();
    for (const Death& death : black_listed_)
        list.push_back({{"hash", death.hash}, {"program", death.program}});
    attempt([&] { black_list_.write(list.dump()); });
}

}  // namespace eddy
