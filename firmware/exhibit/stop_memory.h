#pragma once
#include <filesystem>

namespace eddy {

/// That somebody pressed the stop and nobody has clicked since, over restarts of the program, which may come just then: a file
/// in the run folder, gone when the machine is switched off. One thread. It is no great matter if the file cannot be written: a
/// program that runs remembers by itself.
class StopMemory {
  public:
    /// Empty: nothing is remembered.
    explicit StopMemory(std::filesystem::path file);

    /// Somebody had pressed it before this began.
    bool held() const { return held_; }
    void pressed();
    void clicked();

  private:
    std::filesystem::path file_;
    bool held_ = false, written_ = false;
};

}  // namespace eddy
