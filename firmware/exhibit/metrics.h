#pragma once
#include <filesystem>
#include <string>

#include "firmware/status.h"

namespace eddy {

/// The figures of status.json that somebody may want to watch over time, as Prometheus reads them: node_exporter's textfile
/// collector takes the file from the run folder, or from wherever unattended.metrics_file says. There is no port.
std::string metrics_text(const Status& status);

/// Replaces the file in one step. A disk that is full or gone must not stop the show: returns false then.
bool write_metrics(const std::filesystem::path& file, const Status& status);

}  // namespace eddy
