#include "firmware/recorder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "firmware/force_plot.h"
#include "firmware/png_file.h"
#include "firmware/text_file.h"
#include "gles/render/window.h"

namespace eddy {

Recorder::Recorder(std::filesystem::path folder) : folder_(std::move(folder)) {
    make_folder(folder_);
    // Nothing of an earlier run may stay among what is new.
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        const std::string name = entry.path().filename().string();
        if ((name.starts_with("frame_") && name.ends_with(".png")) || name.starts_with("motion."))
            std::filesystem::remove(entry.path());
    }
    force_.open(folder_ / "force.csv");
    if (!force_)
        throw std::runtime_error(
            fmt::format("{}: cannot be created: {}", (folder_ / "force.csv").string(), std::strerror(errno)));
    force_ << "t_s,x_m,y_m,z_m,raw_x_n,raw_y_n,raw_z_n,filtered_x_n,filtered_y_n,filtered_z_n,sent_x_n,sent_"
              "y_n,sent_z_n,"
              "fluid_age_s,gate\n";
}

void Recorder::add(std::span<const TickRecord> ticks) {
    for (const TickRecord& tick : ticks) {
        const glm::dvec3 &x = tick.position_m, &raw = tick.raw_force_n, &filtered = tick.filtered_force_n,
                         &sent = tick.sent_force_n;
        force_ << fmt::format(
            "{:.6f},{:.7f},{:.7f},{:.7f},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:."
            "6f},{}\n",
            Seconds(tick.t).count(), x.x, x.y, x.z, raw.x, raw.y, raw.z, filtered.x, filtered.y, filtered.z,
            sent.x, sent.y, sent.z, Seconds(tick.fluid_age).count(), to_word(tick.reason));
    }
}

void Recorder::add(gles::Gpu& gpu, const gles::Texture& picture) {
    write_png(folder_ / fmt::format("frame_{:04}.png", frames_++), picture.size().x, picture.size().y,
              gles::rgb_from_top(gpu, picture));
}

void Recorder::finish() {
    force_.close();
    if (!force_)
        throw std::runtime_error(
            fmt::format("{}: the disk did not take all of it", (folder_ / "force.csv").string()));
    plotted_ = plot_forces(folder_ / "force.csv").has_value();
}

}  // namespace eddy
