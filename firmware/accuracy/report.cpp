#include "firmware/accuracy/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/diagnostic.h"
#include "firmware/accuracy/convergence.h"

namespace eddy::accuracy {
namespace {

std::string grid_text(const Row& row) {
    return fmt::format("{}x{}x{}", row.cells.x, row.cells.y, row.cells.z);
}

std::string grids_text(const std::vector<int>& grids) {
    std::string text;
    for (const int n : grids) text += fmt::format("{}{}", text.empty() ? "" : ",", n);
    return text;
}

/// 0.0123 as "1.23 %" where errors are relative.
std::string error_text(const Quantity& quantity, double error) {
    return quantity.error == Quantity::Error::Relative ? fmt::format("{:.3g} %", 100.0 * error)
                                                       : fmt::format("{:.3g}", error);
}

std::string limit_text(const Quantity& quantity, const Reading& reading) {
    std::string text;
    if (reading.limit) text = "<= " + error_text(quantity, *reading.limit);
    if (reading.least_order)
        text += fmt::format("{}order >= {:.2g}", text.empty() ? "" : ", ", *reading.least_order);
    return text;
}

const char* word(const Reading& reading) {
    if (reading.covers) return *reading.covers ? "covers" : "short";
    switch (reading.verdict) {
        case Verdict::Unjudged:
            return "";
        case Verdict::Met:
            return "ok";
        case Verdict::Missed:
            return "MISSED";
    }
    throw std::logic_error("a verdict without a word");
}

std::string order_text(const Reading& reading) {
    return reading.order ? fmt::format("{:.2f}", *reading.order) : "";
}

/// Columns: the quantity, measured, exact, error, order, limit, verdict.
std::string reading_text(const Quantity& quantity, const Reading& reading, std::size_t name_width) {
    return fmt::format("{:<{}}  {:>11.5g}  {:>10.5g}  {:>9}  {:>5}  {:<8} {}", quantity.name, name_width,
                       reading.measured, quantity.exact, error_text(quantity, reading.error),
                       order_text(reading), word(reading), limit_text(quantity, reading));
}

std::size_t widest_name(const Case& one) {
    std::size_t width = 8;
    for (const Quantity& quantity : one.quantities) width = std::max(width, quantity.name.size());
    return width;
}

/// Lines must not end in blanks.
std::string trimmed(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

/// What the three finest grids say of the value without a grid.
std::string extrapolated(const Study& study) {
    std::string text;
    if (study.rows.size() < 3) return text;
    for (std::size_t q = 0; q < study.of->quantities.size(); ++q) {
        if (study.of->quantities[q].error != Quantity::Error::Relative)
            continue;  // the value is an error itself
        std::array<Result, 3> finest;
        for (std::size_t i = 0; i < 3; ++i) {
            const Row& row = study.rows[study.rows.size() - 1 - i];
            finest[i] = {row.cell_m, row.readings[q].measured};
        }
        if (const std::optional<Extrapolation> e = extrapolate(finest))
            text += fmt::format(
                "  {}: {:.5g} at h = 0 (Richardson, order {:.2f}); grid convergence index {:.2g} %\n",
                study.of->quantities[q].name, e->value, e->order, 100.0 * e->gci);
    }
    return text;
}

}  // namespace

std::string list_of(std::span<const Case> cases) {
    std::size_t width = 0;
    for (const Case& one : cases) width = std::max(width, one.name.size());
    std::string text = fmt::format("{:<{}} {:<12} {}\n", "case", width, "cells", "with --full");
    for (const Case& one : cases)
        text += fmt::format("{:<{}} {:<12} {:<16} {}\n", one.name, width, grids_text(one.quick),
                            grids_text(one.full), one.title);
    return text;
}

std::string table_of(const Study& study) {
    const Case& one = *study.of;
    const std::size_t width = widest_name(one);
    std::string text = fmt::format("\n{}  {}\n", one.name, one.title);
    text += fmt::format("  eddy simulate {}", one.scene);
    for (const std::string& change : one.set) text += fmt::format(" --set '{}'", change);
    text += "\n";
    for (const Quantity& quantity : one.quantities)
        text += fmt::format("  {}: {}\n", quantity.name, quantity.source);
    text +=
        fmt::format("  {:<12}{:>10}{:>7}{:>9}{:>9}  {:<{}}  {:>11}  {:>10}  {:>9}  {:>5}\n", "grid", "dt [s]",
                    "steps", "ms/step", "total s", "quantity", width, "measured", "exact", "error", "order");
    for (const Row& row : study.rows)
        for (std::size_t q = 0; q < row.readings.size(); ++q) {
            const std::string head =
                q == 0 ? fmt::format("  {:<12}{:>10.4g}{:>7}{:>9.1f}{:>9.1f}  ", grid_text(row), row.dt_s,
                                     row.steps, row.step_ms, row.total_s)
                       : std::string(51, ' ');
            text += trimmed(head + reading_text(one.quantities[q], row.readings[q], width));
        }
    return text + extrapolated(study);
}

std::string summary_of(std::span<const Study> studies) {
    std::size_t width = 8, case_width = 8;
    for (const Study& study : studies) {
        width = std::max(width, widest_name(*study.of));
        case_width = std::max(case_width, study.of->name.size());
    }
    std::string text =
        fmt::format("\n{:<{}}  {:<12}{:>9}  {:<{}}  {:>11}  {:>10}  {:>9}  {:>5}\n", "summary", case_width,
                    "finest grid", "total s", "quantity", width, "measured", "exact", "error", "order");
    int judged = 0, met = 0, estimates = 0, covering = 0;
    double total_s = 0.0;
    for (const Study& study : studies) {
        double seconds = 0.0;
        for (const Row& row : study.rows) {
            seconds += row.total_s;
            for (const Reading& reading : row.readings) {
                judged += reading.verdict != Verdict::Unjudged;
                met += reading.verdict == Verdict::Met;
                estimates += reading.covers.has_value();
                covering += reading.covers.value_or(false);
            }
        }
        total_s += seconds;
        const Row& finest = study.rows.back();
        for (std::size_t q = 0; q < finest.readings.size(); ++q) {
            const std::string head = q == 0 ? fmt::format("{:<{}}  {:<12}{:>9.1f}  ", study.of->name,
                                                          case_width, grid_text(finest), seconds)
                                            : std::string(case_width + 25, ' ');
            text += trimmed(head + reading_text(study.of->quantities[q], finest.readings[q], width));
        }
    }
    if (estimates > 0)
        text += fmt::format("{} of {} estimates cover the error they are of\n", covering, estimates);
    return text + fmt::format("{} of {} limits met, in {:.0f} s\n", met, judged, total_s);
}

std::string csv_header() {
    return "case,cells_x,cells_y,cells_z,dt_s,steps,step_ms,total_s,quantity,measured,exact,error,order,"
           "limit,"
           "least_order,verdict\n";
}

std::string csv_of(const Study& study) {
    const auto optional = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.6g}", *value) : std::string();
    };
    std::string text;
    for (const Row& row : study.rows)
        for (std::size_t q = 0; q < row.readings.size(); ++q) {
            const Quantity& quantity = study.of->quantities[q];
            const Reading& r = row.readings[q];
            text +=
                fmt::format("{},{},{},{},{:.9g},{},{:.4g},{:.4g},{},{:.9g},{:.9g},{:.6g},{},{},{},{}\n",
                            study.of->name, row.cells.x, row.cells.y, row.cells.z, row.dt_s, row.steps,
                            row.step_ms, row.total_s, in_quotes(quantity.name), r.measured, quantity.exact,
                            r.error, optional(r.order), optional(r.limit), optional(r.least_order), word(r));
        }
    return text;
}

}  // namespace eddy::accuracy
