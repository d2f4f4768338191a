#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "hal/display/kms/console.h"
#include "hal/display/kms/drm_card.h"
#include "hal/display/kms/plug_monitor.h"

namespace eddy::kms {
namespace {

namespace fs = std::filesystem;

bool is_number(const std::string& text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// "plymouthd (process 231)".
std::string name_of(const fs::path& process) {
    std::string name;
    std::getline(std::ifstream(process / "comm") >> std::ws, name);
    return fmt::format("{} (process {})", name, process.filename().string());
}

class ThisMachine final : public Machine {
  public:
    std::vector<std::string> cards() override {
        std::vector<std::pair<int, std::string>> found;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator("/dev/dri", none)) {
            const std::string name = entry.path().filename();
            if (name.starts_with("card") && is_number(name.substr(4)))
                found.emplace_back(std::stoi(name.substr(4)), entry.path());
        }
        std::sort(found.begin(), found.end());
        std::vector<std::string> paths;
        for (auto& [number, path] : found) paths.push_back(std::move(path));
        return paths;
    }
    Opened open(const std::string& path) override { return open_drm_card(path); }
    std::unique_ptr<WindowMaker> make_windows(Card& card) override { return make_gbm_windows(card); }
    bool plugs_changed() override { return plugs_.changed(); }
    std::string holders(const std::string& path) override {
        std::string who;
        std::error_code none;
        for (const auto& process : fs::directory_iterator("/proc", none)) {
            const std::string number = process.path().filename();
            if (!is_number(number) || number == std::to_string(getpid())) continue;
            std::error_code hidden;  // of other users, but for root
            for (const auto& file : fs::directory_iterator(process.path() / "fd", hidden)) {
                std::error_code gone;
                if (fs::read_symlink(file.path(), gone) != path) continue;
                who += (who.empty() ? "" : ", ") + name_of(process.path());
                break;
            }
        }
        return who;
    }
    void set_console_text(bool on) override { console_.set_text(on); }

  private:
    PlugMonitor plugs_;
    Console console_;
};

}  // namespace

std::unique_ptr<Machine> make_machine() {
    return std::make_unique<ThisMachine>();
}

}  // namespace eddy::kms
