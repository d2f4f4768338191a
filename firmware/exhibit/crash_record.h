#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/exhibit/line_ring.h"
#include "firmware/haptic/flight_recorder.h"

namespace eddy {

/// When the program ends badly (SEGV, BUS, FPE, ILL, ABRT, which is the watchdog's too), writes what it knows into the state folder
/// and lets the default action happen: the signal, how long it ran, its build, the last lines of the log, and what the flight
/// recorder has in memory. The handler calls nothing but write(2), into a file that was opened before. One in a process.
class CrashRecord {
  public:
    /// Of each: records, and the flights that belong to them.
    static constexpr std::size_t kMostKept = 3;

    /// `folder`: of the state; where it cannot be written, there will be no record. `lines` must outlive this.
    CrashRecord(const std::filesystem::path& folder, const LineRing& lines);
    /// The signals do again what they did before.
    ~CrashRecord();
    CrashRecord(const CrashRecord&) = delete;
    CrashRecord& operator=(const CrashRecord&) = delete;

    /// From now on its memory is written too; null: no more. It must outlive this, or be taken back before it ends.
    void watch(const FlightRecorder* flights);

    /// To be called at the start, before one is made. Of a crash of the run before: its record is put where it is kept, as a text, and its last
    /// seconds as a flight that `eddy replay` reads. Lines for the log.
    static std::vector<std::string> take_over(const std::filesystem::path& folder);

  private:
    std::filesystem::path file_;
    int fd_ = -1;
};

}  // namespace eddy
