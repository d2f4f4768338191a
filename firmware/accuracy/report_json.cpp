#include <nlohmann/json.hpp>

#include "firmware/accuracy/report.h"
#include "firmware/machine.h"

namespace eddy::accuracy {
namespace {

const char* word(Quantity::Error error) {
    switch (error) {
        case Quantity::Error::Relative:
            return "relative";
        case Quantity::Error::Absolute:
            return "absolute";
        case Quantity::Error::Shortfall:
            return "shortfall";
    }
    throw std::logic_error("an error without a word");
}

nlohmann::ordered_json json_of(const Quantity& quantity, const Reading& reading) {
    nlohmann::ordered_json j{{"name", quantity.name},   {"measured", reading.measured},
                             {"exact", quantity.exact}, {"source", quantity.source},
                             {"error", reading.error},  {"error_is", word(quantity.error)}};
    if (reading.order) j["order"] = *reading.order;
    if (reading.limit) j["limit"] = *reading.limit;
    if (reading.least_order) j["least_order"] = *reading.least_order;
    if (reading.covers) j["covers_error"] = *reading.covers;
    if (reading.verdict != Verdict::Unjudged) j["met"] = reading.verdict == Verdict::Met;
    return j;
}

}  // namespace

std::string json_of(std::span<const Study> studies, const gles::Capabilities& driver) {
    nlohmann::ordered_json j{{"eddy_version", EDDY_VERSION},
                             {"renderer", driver.renderer},
                             {"gl_version", driver.version},
                             {"machine", describe_machine()},
                             {"cases", nlohmann::ordered_json::array()}};
    for (const Study& study : studies) {
        nlohmann::ordered_json one{{"name", study.of->name},
                                   {"title", study.of->title},
                                   {"scene", study.of->scene},
                                   {"set", study.of->set}};
        for (const Row& row : study.rows) {
            nlohmann::ordered_json grid{{"cells", {row.cells.x, row.cells.y, row.cells.z}},
                                        {"dt_s", row.dt_s},
                                        {"steps", row.steps},
                                        {"step_ms_p50", row.step_ms},
                                        {"total_s", row.total_s}};
            for (std::size_t q = 0; q < row.readings.size(); ++q)
                grid["quantities"].push_back(json_of(study.of->quantities[q], row.readings[q]));
            one["grids"].push_back(grid);
        }
        j["cases"].push_back(one);
    }
    return j.dump(2) + "\n";
}

}  // namespace eddy::accuracy
