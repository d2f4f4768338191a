#include "firmware/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "gles/fluid/fluid.h"

namespace eddy {
namespace {

std::string describe(const gles::Texture& texture) {
    return fmt::format("{} {}x{}", gles::to_string(texture.format()), texture.size().x, texture.size().y);
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::vector<gles::PassRecord> third_step(gles::Gpu& gpu, gles::Fluid& fluid, const BodySchedule& motions,
                                         double dt_s) {
    std::vector<gles::PassRecord> records;
    for (int n = 1; n <= 3; ++n) {
        if (n == 3) gpu.record(&records);
        fluid.step(dt_s, motions.at(n * dt_s, dt_s), false);
        gpu.record(nullptr);
        fluid.result(true);
    }
    return records;
}

/// The same pass several times in a row (sweeps, boxes) is one line with a count.
struct Line {
    gles::PassRecord first;
    Work work;
};

std::string columns(const std::string& stage, const std::string& pass, const Work& work) {
    return fmt::format("{:<16} {:<22} {:>5} {:>11} {:>12} {:>13}", stage, pass, work.passes, work.texels,
                       work.bytes, work.fetches);
}

}  // namespace

void Work::add(const gles::PassRecord& record) {
    ++passes;
    uniforms += static_cast<std::int64_t>(record.uniforms.size());
    texels += record.texels;
    bytes += record.bytes;
    fetches += record.fetches;
}

std::string plan_of(gles::Gpu& gpu, const gles::FluidSetup& setup, const BodySchedule& motions, double dt_s) {
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    std::vector<Line> lines;
    Work total;
    for (const gles::PassRecord& record : third_step(gpu, *fluid, motions, dt_s)) {
        auto same = std::find_if(lines.begin(), lines.end(), [&](const Line& line) {
            return line.first.stage == record.stage && line.first.pass == record.pass;
        });
        if (same == lines.end()) same = lines.insert(lines.end(), Line{record, {}});
        same->work.add(record);
        total.add(record);
    }
    std::string text =
        fmt::format("{:<16} {:<22} {:>5} {:>11} {:>12} {:>13}  {:<34} {:<20} {}\n", "stage", "pass", "times",
                    "texels", "bytes", "fetches", "reads", "writes", "uniforms");
    for (const Line& line : lines) {
        std::string writes = describe(*line.first.outputs[0]);
        if (line.first.outputs.size() > 1) writes += fmt::format(" (x{})", line.first.outputs.size());
        text += fmt::format("{}  {:<34} {:<20} {}\n", columns(line.first.stage, line.first.pass, line.work),
                            joined(line.first.inputs), writes, joined(line.first.uniforms));
    }
    text += columns("total", "", total) + "\n";
    text += fmt::format("\ntextures: {}, {:.1f} MB\n", gpu.textures().made(),
                        static_cast<double>(gpu.textures().bytes()) / 1e6);
    return text;
}

StepCost cost_of(gles::Gpu& gpu, const gles::FluidSetup& setup, const BodySchedule& motions, double dt_s) {
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    StepCost cost;
    for (const gles::PassRecord& record : third_step(gpu, *fluid, motions, dt_s)) cost.work.add(record);
    cost.textures = gpu.textures().made();
    cost.texture_bytes = gpu.textures().bytes();
    return cost;
}

}  // namespace eddy
