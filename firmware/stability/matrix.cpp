#include "firmware/stability/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>

#include "firmware/built_from.h"
#include "firmware/input_error.h"
#include "firmware/machine.h"

namespace eddy::stability {
namespace {

constexpr long kQuickSteps = 60;
/// A case that takes more steps until all of it has happened gets them, but for those that take more than this.
constexpr long kMostQuickSteps = 500;

/// Those that everybody's tests try at once: one of each kind, each hard by itself. Named as in the whole product.
constexpr const char* kQuickPairs[] = {"stall+inflow-20hz",          "teleport-50+late-answers",
                                       "covers-all+nan-in-pressure", "jitter+piston",
                                       "plate-turning+friction-10",  "courant-50+cross-through"};

std::vector<const Case*> pair_named(const std::string& name) {
    const std::size_t plus = name.find('+');
    std::vector<const Case*> both;
    for (const std::string& one : {name.substr(0, plus), name.substr(plus + 1)}) {
        const std::vector<const Case*> found = cases_named(one);
        if (found.size() != 1)
            throw InputError(fmt::format("--case {}: of pairs give names: {} is several cases", name, one));
        both.push_back(found.front());
    }
    for (const Case* one : both)
        if (one->alone)
            throw InputError(fmt::format("--case {}: {} can only be tried alone", name, one->name));
    return both;
}

/// Whether it is worth having beside any other: not too long, and not about a grid of its own.
bool pairs_up(const Case& one) {
    return !one.alone && one.grids.empty() && !one.full_only && one.steps <= 1500;
}

std::vector<std::vector<const Case*>> asked_for(const Order& order) {
    std::vector<std::vector<const Case*>> rows;
    for (const std::string& name : order.cases) {
        if (name.find('+') != std::string::npos)
            rows.push_back(pair_named(name));
        else
            for (const Case* one : cases_named(name)) rows.push_back({one});
    }
    if (!order.cases.empty()) return rows;
    for (const Case& one : all_cases())
        if (!one.full_only || order.extent == Extent::Full) rows.push_back({&one});
    if (order.extent == Extent::Full) {
        for (std::size_t i = 0; i < all_cases().size(); ++i)
            for (std::size_t j = i + 1; j < all_cases().size(); ++j)
                if (pairs_up(all_cases()[i]) && pairs_up(all_cases()[j]))
                    rows.push_back({&all_cases()[i], &all_cases()[j]});
    } else {
        for (const char* name : kQuickPairs) rows.push_back(pair_named(name));
    }
    return rows;
}

bool is_quick_pair(const std::vector<const Case*>& row) {
    const std::string name = row[0]->name + "+" + row[1]->name;
    return std::find(std::begin(kQuickPairs), std::end(kQuickPairs), name) != std::end(kQuickPairs);
}

std::vector<glm::ivec3> usual_grids(const std::vector<const Case*>& row, Extent extent) {
    if (row.size() > 1 && extent != Extent::Quick && is_quick_pair(row))
        return {glm::ivec3(8), glm::ivec3(25)};
    if (row.size() > 1) return {glm::ivec3(25)};
    if (extent == Extent::Quick) return {glm::ivec3(8)};
    if (extent == Extent::Usual || row.front()->small_only) return {glm::ivec3(8), glm::ivec3(25)};
    return {glm::ivec3(8), glm::ivec3(25), glm::ivec3(33, 47, 29), glm::ivec3(64)};
}

std::vector<glm::ivec3> grids_for(const std::vector<const Case*>& row, const Order& order) {
    std::vector<glm::ivec3> wanted;
    for (const std::string& name : order.grids) wanted.push_back(grid_named(name));
    const bool has_its_own = row.size() == 1 && !row.front()->grids.empty();
    // Of the full matrix --grid selects; else it is what the user wants, but for a case about grids.
    if (!wanted.empty() && order.extent != Extent::Full && !has_its_own) return wanted;
    std::vector<glm::ivec3> grids = has_its_own ? row.front()->grids : usual_grids(row, order.extent);
    if (!wanted.empty())
        std::erase_if(grids, [&](const glm::ivec3& n) {
            return std::find(wanted.begin(), wanted.end(), n) == wanted.end();
        });
    return grids;
}

long most_steps(const std::vector<const Case*>& row, Extent extent) {
    if (extent != Extent::Quick) return std::numeric_limits<long>::max();
    long most = kQuickSteps;
    for (const Case* one : row)
        if (one->least_steps <= kMostQuickSteps) most = std::max(most, one->least_steps);
    return most;
}

/// A field of a line of CSV.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
}

constexpr const char* kHead =
    "case,name,grid,effort,steps,pass,reason,kinetic_energy_ratio,largest_force_n,recovery_s,non_finite_"
    "texels,"
    "wall_s,remark,tried\n";

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && inside && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (line[i] == '"')
            inside = !inside;
        else if (line[i] == ',' && !inside)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

Result result_from(const std::vector<std::string>& f) {
    Result result{std::stoi(f.at(0)), f.at(1), f.at(2), f.at(3)};
    Verdict& verdict = result.outcome.verdict;
    result.outcome.steps = std::stol(f.at(4));
    verdict.pass = f.at(5) == "yes";
    verdict.reason = f.at(6);
    verdict.kinetic_energy_ratio = std::stod(f.at(7));
    verdict.largest_force_n = std::stod(f.at(8));
    if (!f.at(9).empty()) verdict.recovery_s = std::stod(f.at(9));
    verdict.non_finite = std::stol(f.at(10));
    result.outcome.wall_s = std::stod(f.at(11));
    result.outcome.remark = f.at(12);
    result.tried = f.at(13);
    return result;
}

}  // namespace

std::string Cell::name() const {
    std::string name;
    for (const Case* one : cases) name += (name.empty() ? "" : "+") + one->name;
    return name;
}

long Cell::steps() const {
    return std::min(most_steps, cases.size() > 1 ? kStepsOfPair : cases.front()->steps);
}

long Cell::all_steps() const {
    return plan_of(cases, trial, most_steps).steps;
}

std::vector<Cell> cells_of(const Order& order) {
    std::vector<Cell> cells;
    for (const std::vector<const Case*>& row : asked_for(order))
        for (const glm::ivec3& grid : grids_for(row, order))
            for (const Effort effort : {Effort::Default, Effort::Least}) {
                // Pairs are many; the solver's best is what the exhibit runs.
                if (row.size() > 1 && effort == Effort::Least) continue;
                cells.push_back({row, {grid, effort}, most_steps(row, order.extent)});
            }
    return cells;
}

bool Result::is_of(const Cell& cell) const {
    return name == cell.name() && grid == grid_name(cell.trial.cells) && effort == to_word(cell.trial.effort);
}

bool Result::counts_for(const Cell& cell) const {
    return is_of(cell) && (!outcome.verdict.pass || outcome.steps >= cell.all_steps());
}

Result result_of(const Cell& cell, const Outcome& outcome) {
    return {cell.cases.front()->number,
            cell.name(),
            grid_name(cell.trial.cells),
            std::string(to_word(cell.trial.effort)),
            outcome,
            date_and_time() + ", " + std::string(kBuiltFrom)};
}

const Result* find(std::span<const Result> results, const Cell& cell) {
    const auto found = std::find_if(results.begin(), results.end(),
                                    [&](const Result& result) { return result.counts_for(cell); });
    return found == results.end() ? nullptr : &*found;
}

std::vector<std::size_t> telling_first(std::span<const Cell> cells, std::span<const Result> known) {
    std::set<std::string> red;
    for (const Result& result : known)
        if (!result.outcome.verdict.pass) red.insert(result.name);
    const auto rank = [&](std::size_t i) {
        const glm::ivec3& n = cells[i].trial.cells;
        return std::tuple(cells[i].cases.size(), n.x * n.y * n.z, n.x, n.y, !red.contains(cells[i].name()),
                          cells[i].trial.effort);
    };
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    return order;
}

std::string csv_of(std::span<const Result> results) {
    std::string text = kHead;
    for (const Result& r : results) {
        const Verdict& v = r.outcome.verdict;
        text += fmt::format("{},{},{},{},{},{},{},{:.6g},{:.6g},{},{},{:.3f},{},{}\n", r.number, r.name,
                            r.grid, r.effort, r.outcome.steps, v.pass ? "yes" : "no", quoted(v.reason),
                            v.kinetic_energy_ratio, v.largest_force_n,
                            v.recovery_s ? fmt::format("{:.3f}", *v.recovery_s) : "", v.non_finite,
                            r.outcome.wall_s, quoted(r.outcome.remark), quoted(r.tried));
    }
    return text;
}

std::vector<Result> results_from_csv(const std::string& text, const std::filesystem::path& file) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    std::vector<Result> results;
    if (line + "\n" != kHead)
        throw InputError(fmt::format("{}: is not what eddy stability writes", file.string()));
    for (int number = 2; std::getline(lines, line); ++number) {
        try {
            results.push_back(result_from(fields_of(line)));
        } catch (const std::logic_error&) {  // a field that is missing, or a number that is none
            throw InputError(fmt::format("{}:{}: is not what eddy stability writes", file.string(), number));
        }
    }
    return results;
}

std::vector<Result> merged(std::span<const Cell> cells, std::span<const std::vector<Result>> parts) {
    std::vector<Result> all;
    for (const Cell& cell : cells) {
        const Result* newest = nullptr;
        for (const std::vector<Result>& part : parts)
            if (const Result* found = find(part, cell)) newest = found;
        if (newest) all.push_back(*newest);
    }
    return all;
}

}  // namespace eddy::stability
