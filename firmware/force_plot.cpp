#include "firmware/force_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "firmware/gnuplot.h"

namespace eddy {
namespace {

/// A point of the path, thinned to 25 a second so that arrows stay apart; lengths in mm, forces in N.
struct Point {
    double x, y, z, fx, fy, fz;
    double force() const { return std::sqrt(fx * fx + fy * fy + fz * fz); }
};

std::vector<Point> read_points(const std::filesystem::path& csv) {
    std::vector<Point> points;
    std::ifstream in(csv);
    std::string line;
    std::getline(in, line);  // the header
    for (long n = 0; std::getline(in, line); ++n) {
        if (n % 40 != 0) continue;
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        double t, x, y, z, skip, fx, fy, fz;
        numbers >> t >> x >> y >> z;
        for (int i = 0; i < 6; ++i) numbers >> skip;  // raw and filtered force
        if (numbers >> fx >> fy >> fz) points.push_back({1e3 * x, 1e3 * y, 1e3 * z, fx, fy, fz});
    }
    return points;
}

}  // namespace

std::optional<std::filesystem::path> plot_forces(const std::filesystem::path& force_csv) {
    const std::vector<Point> points = read_points(force_csv);
    if (points.empty()) return std::nullopt;
    double strongest = 0.0;
    for (const Point& p : points) strongest = std::max(strongest, p.force());
    // The longest arrow is 25 mm.
    const double mm_per_n = strongest > 0.0 ? 25.0 / strongest : 0.0;

    // gnuplot's third axis points up, the Device frame's second does: plot x, z towards the visitor, y. The
    // axes form a cube just large enough for the path and its arrows.
    std::string data;
    double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
    for (const Point& p : points) {
        const double from[3] = {p.x, p.z, p.y};
        const double arrow[3] = {mm_per_n * p.fx, mm_per_n * p.fz, mm_per_n * p.fy};
        for (int a = 0; a < 3; ++a) {
            low[a] = std::min({low[a], from[a], from[a] + arrow[a]});
            high[a] = std::max({high[a], from[a], from[a] + arrow[a]});
        }
        data += fmt::format("{:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f}\n", from[0], from[1], from[2],
                            arrow[0], arrow[1], arrow[2]);
    }
    const double half = 2.0 + 0.5 * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    std::string ranges;
    for (int a = 0; a < 3; ++a) {
        const double middle = 0.5 * (low[a] + high[a]);
        ranges += fmt::format("set {}range [{:.1f}:{:.1f}]\n", "xyz"[a], middle - half, middle + half);
    }
    const GnuplotPicture picture{
        force_csv.parent_path() / "motion.png", 1000, 800,
        fmt::format("set border 31\n"
                    "$path << EOD\n{}EOD\n"
                    "set title 'Hand (blue) and force on it (red; the longest arrow is {:.2f} N)'\n"
                    "set xlabel 'x right [mm]' offset 0,-1\nset ylabel 'z to the visitor [mm]' offset 7,-1\n"
                    "set zlabel 'y up [mm]' rotate parallel\n"
                    "set view 70, 25\nset view equal xyz\nset xyplane relative 0\nset key off\n{}"
                    "splot $path using 1:2:3:4:5:6 with vectors nohead lc rgb '#d03020', \\\n"
                    "      $path using 1:2:3 with points pt 7 ps 0.5 lc rgb '#2050c0'\n",
                    data, strongest, ranges)};
    if (draw_with_gnuplot({picture}).empty()) return std::nullopt;
    return picture.file;
}

}  // namespace eddy
