#include <fmt/format.h>

#include "firmware/accuracy/report.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

/// A case, changed as the user wants it, and the grids it is to run on.
struct Task {
    accuracy::Case of;
    std::vector<int> grids;
};

std::vector<Task> tasks_of(const AccuracyOptions& options) {
    std::vector<const accuracy::Case*> cases;
    for (const std::string& name : options.cases)
        for (const accuracy::Case* one : accuracy::cases_named(name)) cases.push_back(one);
    if (options.cases.empty())
        for (const accuracy::Case& one : accuracy::all_cases()) cases.push_back(&one);
    std::vector<Task> tasks;
    for (const accuracy::Case* one : cases) {
        const std::vector<int>& grids = options.full || one->quick.empty() ? one->full : one->quick;
        // What is too long for a quick look at all cases is there for who asks for it by its name.
        if (one->quick.empty() && !options.full && options.cases.empty()) continue;
        Task& task = tasks.emplace_back(Task{*one, options.grids.empty() ? grids : options.grids});
        task.of.set.insert(task.of.set.end(), options.set.begin(), options.set.end());
        for (const int cells : task.grids)
            accuracy::scene_on_grid(task.of, cells, options.grids.empty() ? kNoGridOption : kGridOption);
    }
    return tasks;
}

}  // namespace

int validate(const AccuracyOptions& options) {
    if (options.list) {
        fmt::print("{}", accuracy::list_of(accuracy::all_cases()));
        return 0;
    }
    if (!options.validate)
        throw InputError(
            "eddy: accuracy: say --validate to run cases, --list to see them, or --sweep to hold error "
            "against time");
    const std::vector<Task> tasks = tasks_of(options);
    if (!options.json.empty()) check_destination("--json", options.json);
    const std::unique_ptr<Graphics> graphics = open_headless();
    const gles::Capabilities& driver = graphics->gpu.capabilities();
    if (options.csv)
        fmt::print("{}", accuracy::csv_header());
    else
        fmt::print("{} ({}, {})\n{}\n", driver.renderer, driver.vendor, driver.version, describe_machine());

    std::vector<accuracy::Study> studies;
    bool missed = false;
    for (const Task& task : tasks) {
        studies.push_back(accuracy::study(graphics->gpu, task.of, task.grids));
        missed |= accuracy::missed(studies.back());
        fmt::print("{}", options.csv ? csv_of(studies.back()) : table_of(studies.back()));
        std::fflush(stdout);
    }
    if (!options.csv) fmt::print("{}", accuracy::summary_of(studies));
    if (!options.json.empty()) {
        replace_text_file(options.json, accuracy::json_of(studies, driver));
        if (!options.csv) fmt::print("written to {}\n", options.json);
    }
    return missed ? 1 : 0;
}

}  // namespace eddy
