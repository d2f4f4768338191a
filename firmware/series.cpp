#include "firmware/series.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace eddy {

Series::Series(std::filesystem::path file, std::vector<std::string> bodies, const More& more)
    : file_(std::move(file)), beside_(file_.string() + ".new"), bodies_(std::move(bodies)), out_(beside_) {
    if (!out_)
        throw std::runtime_error(
            fmt::format("{}: cannot be created: {}", file_.string(), std::strerror(errno)));
    out_ << "t_s,body,force_x_n,force_y_n,force_z_n,torque_x_nm,torque_y_nm,torque_z_nm,kinetic_energy_j,"
            "divergence_max_1_s,pressure_residual,smoke_total,step_ms,"
            "x_m,y_m,z_m,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s,orientation_w,orientation_x,"
            "orientation_y,orientation_z,spin_x_rad_s,spin_y_rad_s,spin_z_rad_s";
    for (const std::string& column : more.of_each_body) out_ << ',' << column;
    for (const std::string& column : more.of_all) out_ << ',' << column;
    out_ << '\n';
}

void Series::add(double time_s, const gles::StepResult& result, const std::vector<gles::BodyState>& bodies,
                 double step_ms, const MoreValues& more) {
    const gles::Diagnostics d = result.diagnostics.value_or(gles::Diagnostics{});
    const double residual =
        d.divergence_before_1_s > 0.0 ? d.divergence_max_1_s / d.divergence_before_1_s : 0.0;
    const auto add_values = [&](const std::vector<double>& values) {
        for (const double value : values) out_ << fmt::format(",{:.9e}", value);
    };
    const auto row = [&](std::string_view body, const gles::Load& load, const gles::BodyState& b,
                         const std::vector<double>& of_body) {
        out_ << fmt::format(
            "{:.6f},{},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.6e},{:.6e},{:.9e},{:.3f},", time_s,
            body, load.force_n.x, load.force_n.y, load.force_n.z, load.torque_nm.x, load.torque_nm.y,
            load.torque_nm.z, d.kinetic_energy_j, d.divergence_max_1_s, residual, d.smoke_total, step_ms);
        const glm::dvec3 &x = b.centre_m, &v = b.velocity_m_s, &spin = b.spin_rad_s;
        const glm::dquat& q = b.orientation;
        out_ << fmt::format(
            "{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9f},{:.9f},{:.9f},{:.9f},{:.9e},{:.9e},{:.9e}", x.x,
            x.y, x.z, v.x, v.y, v.z, q.w, q.x, q.y, q.z, spin.x, spin.y, spin.z);
        add_values(of_body);
        add_values(more.of_all);
        out_ << '\n';
    };
    if (bodies_.empty()) row("-", {}, {}, {});
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        row(bodies_[i], result.loads[i], bodies[i],
            more.of_each_body.empty() ? std::vector<double>() : more.of_each_body[i]);
}

void Series::finish() {
    out_.close();
    if (!out_) throw std::runtime_error(fmt::format("{}: the disk did not take all of it", file_.string()));
    std::filesystem::rename(beside_, file_);
}

}  // namespace eddy
