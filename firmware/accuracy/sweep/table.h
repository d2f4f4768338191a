#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/accuracy/sweep/pareto.h"

namespace eddy::accuracy::sweep {

/// What a sweep, or a shard of one, has measured, and on what.
struct Table {
    std::string version;   ///< of Eddy
    std::string renderer;  ///< of GL
    std::vector<std::string> machines;
    Order order;
    std::size_t points = 0;                  ///< of the whole sweep
    std::vector<Measurement> measured = {};  ///< by index
    bool operator==(const Table&) const = default;
};

/// Those of one case whose force is summed over the surface, as an exhibit does it.
Chosen points_of(const Table& table, const std::string& problem);

/// A line for each point: times in ms, errors as shares of 1.
std::string csv_of(const Table& table);
/// Everything.
std::string json_of(const Table& table);
/// What json_of() wrote. Throws InputError that names the file.
Table table_from_json(const std::string& text, const std::filesystem::path& file);

/// All points of a sweep from the tables of its shards; `names` are what complaints call these. Throws InputError if they
/// are not of one sweep by one version on one renderer, or if a point is there twice or not at all.
Table merged(std::span<const Table> shards, std::span<const std::string> names);

}  // namespace eddy::accuracy::sweep
