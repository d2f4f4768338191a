#include "firmware/flight_plot.h"

#include <fmt/format.h>

#include "firmware/gnuplot.h"

namespace eddy {

bool plot_flight(const Flight& flight, const std::filesystem::path& png) {
    std::string data;
    for (const FlightTick& tick : flight.ticks) {
        const double silence_ms = tick.in.silence.count() * 1e3;
        const glm::dvec3 hand_mm =
            1e3 * tick.in.orders.tank_from_device.device_position(tick.out.pose.position_m);
        // What cannot be drawn is left out: gnuplot breaks the line at nan.
        data += fmt::format("{:.4f} {:.5g} {:.5g} {:.5g} {:.4f} {:.4f} {:.4f} {:.4g} {:.4g}\n",
                            Seconds(tick.in.now - flight.at).count(), glm::length(tick.out.raw_n),
                            glm::length(tick.out.filtered_n), glm::length(tick.out.force_n), hand_mm.x,
                            hand_mm.y, hand_mm.z, silence_ms,
                            Seconds(tick.in.now - tick.in.fluid.computed_for).count() * 1e3);
    }
    const double first = Seconds(flight.ticks.front().in.now - flight.at).count();
    const double last = Seconds(flight.ticks.back().in.now - flight.at).count();
    const GnuplotPicture picture{
        png, 1100, 900,
        fmt::format(
            "$ticks << EOD\n{}EOD\n"
            "set datafile missing 'nan'\nset xrange [{:.4f}:{:.4f}]\nset key outside right top\n"
            "set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb '#d03020' dt 2 front\n"
            "set lmargin 10\nset rmargin 22\n"
            "set multiplot layout 3,1 title {}\n"
            "set ylabel 'force [N]'\n"
            "plot $ticks using 1:2 with lines lc rgb '#b0b0b0' title 'of the fluid', \\\n"
            "     $ticks using 1:3 with lines lc rgb '#2050c0' title 'wanted', \\\n"
            "     $ticks using 1:4 with lines lw 2 lc rgb '#d03020' title 'sent'\n"
            "set ylabel 'body, at the handle [mm]'\n"
            "plot $ticks using 1:5 with lines lc rgb '#2050c0' title 'x, right', \\\n"
            "     $ticks using 1:6 with lines lc rgb '#208040' title 'y, up', \\\n"
            "     $ticks using 1:7 with lines lc rgb '#c08020' title 'z, to the visitor'\n"
            "set ylabel 'age [ms]'\nset xlabel 'seconds from the fault'\nset logscale y\n"
            "plot $ticks using 1:($8 > 0.01 ? $8 : 0.01) with lines lc rgb '#2050c0' title 'device''s "
            "reply', \\\n"
            "     $ticks using 1:($9 > 0.01 ? $9 : 0.01) with lines lc rgb '#208040' title 'fluid''s "
            "pose'\n"
            "unset multiplot\n",
            data, first, last,
            in_gnuplot_quotes(fmt::format("{}: {}", to_word(flight.cause), to_string(flight.cause))))};
    return !draw_with_gnuplot({picture}).empty();
}

}  // namespace eddy
