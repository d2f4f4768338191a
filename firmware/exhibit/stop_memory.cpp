#include "firmware/exhibit/stop_memory.h"

#include <fstream>
#include <utility>

namespace eddy {

StopMemory::StopMemory(std::filesystem::path file) : file_(std::move(file)) {
    std::error_code none;
    held_ = written_ = !file_.empty() && std::filesystem::exists(file_, none);
}

void StopMemory::pressed() {
    if (file_.empty() || written_) return;
    written_ = std::ofstream(file_).good();
}

void StopMemory::clicked() {
    if (!written_) return;
    std::error_code none;
    std::filesystem::remove(file_, none);
    written_ = false;
}

}  // namespace eddy
