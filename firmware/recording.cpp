#include "firmware/recording.h"

#include <fmt/format.h>

#include <stdexcept>

namespace eddy {

void Recording::begin(const std::string& folder) {
    if (!folder.empty()) recorder_.emplace(folder);
}

void Recording::add(std::span<const TickRecord> ticks) {
    if (recorder_) recorder_->add(ticks);
}

void Recording::add(gles::Gpu& gpu, const gles::Texture& picture) {
    if (!recorder_) return;
    try {
        recorder_->add(gpu, picture);
    } catch (const std::runtime_error& e) {
        fmt::print(stderr, "recording stopped: {}\n", e.what());
        recorder_.reset();
        failed_ = true;
    }
}

void Recording::finish() {
    if (recorder_) recorder_->finish();
}

}  // namespace eddy
