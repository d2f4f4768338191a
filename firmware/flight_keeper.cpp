#include "firmware/flight_keeper.h"

#include <fmt/format.h>

#include "firmware/dated_files.h"
#include "firmware/haptic/flight_file.h"
#include "firmware/text_file.h"
#include "firmware/utc_stamp.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view kExtension = ".flight";

}  // namespace

std::vector<std::filesystem::path> flights_in(const std::filesystem::path& folder) {
    return dated_files(folder, "", kExtension);
}

FlightKeeper::FlightKeeper(FlightRecorder& recorder, std::filesystem::path folder)
    : recorder_(recorder), folder_(std::move(folder)), thread_([this] { work(); }) {}

void FlightKeeper::finish() {
    if (!thread_.joinable()) return;
    stop_ = true;
    thread_.join();
    if (auto flight = recorder_.take()) keep(std::move(*flight));
    if (auto flight = recorder_.take_unfinished()) keep(std::move(*flight));
}

void FlightKeeper::work() {
    for (; !stop_; std::this_thread::sleep_for(100ms))
        if (auto flight = recorder_.take()) keep(std::move(*flight));
}

void FlightKeeper::keep(Flight flight) {
    flight.version = EDDY_VERSION;
    flight.written = utc_stamp();
    std::string said;
    try {
        make_folder(folder_);
        const std::string stem = fmt::format("{}-{}", utc_stamp("%Y%m%dT%H%M%SZ"), to_word(flight.cause));
        const std::filesystem::path file = unused_file(folder_, stem, kExtension);
        replace_text_file(file, flight_text(flight));
        keep_newest(flights_in(folder_), kMostFiles, file);
        ++kept_;
        said = fmt::format("{}: the seconds before are in {}; eddy replay runs them again",
                           to_string(flight.cause), file.string());
    } catch (const std::exception& e) {
        said = fmt::format("{}: the seconds before could not be kept: {}", to_string(flight.cause), e.what());
    }
    const std::lock_guard lock(news_lock_);
    news_ = std::move(said);
}

std::optional<std::string> FlightKeeper::news() {
    const std::lock_guard lock(news_lock_);
    return std::exchange(news_, std::nullopt);
}

}  // namespace eddy
