#include "firmware/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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

}  // namespace

std::string plan_of(gles::Gpu& gpu, const gles::FluidSetup& setup, const BodySchedule& motions, double dt_s) {
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    std::vector<gles::PassRecord> records;
    for (int n = 1; n <= 3; ++n) {
        if (n == 3) gpu.record(&records);
        fluid->step(dt_s, motions.at(n * dt_s, dt_s), false);
        gpu.record(nullptr);
        fluid->result(true);
    }

    // The same pass several times in a row (sweeps, boxes) is one line with a count; the sums are over all.
    std::string text = fmt::format("{:<16} {:<22} {:>5} {:>11} {:>12} {:>13}  {:<34} {}\n", "stage", "pass",
                                   "times", "texels", "bytes", "fetches", "reads", "writes");
    std::int64_t texels = 0, bytes = 0, fetches = 0;
    struct Line {
        gles::PassRecord first;
        int times = 0;
        std::int64_t texels = 0, bytes = 0, fetches = 0;
    };
    std::vector<Line> lines;
    for (const gles::PassRecord& record : records) {
        auto same = std::find_if(lines.begin(), lines.end(), [&](const Line& line) {
            return line.first.stage == record.stage && line.first.pass == record.pass;
        });
        if (same == lines.end()) same = lines.insert(lines.end(), Line{record, 0, 0, 0, 0});
        ++same->times;
        same->texels += record.texels;
        same->bytes += record.bytes;
        same->fetches += record.fetches;
        texels += record.texels;
        bytes += record.bytes;
        fetches += record.fetches;
    }
    for (const Line& line : lines) {
        std::string writes = describe(*line.first.outputs[0]);
        if (line.first.outputs.size() > 1) writes += fmt::format(" (x{})", line.first.outputs.size());
        text += fmt::format("{:<16} {:<22} {:>5} {:>11} {:>12} {:>13}  {:<34} {}\n", line.first.stage,
                            line.first.pass, line.times, line.texels, line.bytes, line.fetches,
                            joined(line.first.inputs), writes);
    }
    text += fmt::format("{:<16} {:<22} {:>5} {:>11} {:>12} {:>13}\n", "total", "", records.size(), texels,
                        bytes, fetches);
    text += fmt::format("\ntextures: {}, {:.1f} MB\n", gpu.textures().made(),
                        static_cast<double>(gpu.textures().bytes()) / 1e6);
    return text;
}

}  // namespace eddy
