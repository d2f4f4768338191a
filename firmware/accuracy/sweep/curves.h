#pragma once
#include <functional>
#include <initializer_list>
#include <set>
#include <string>

#include "firmware/accuracy/sweep/pareto.h"
#include "firmware/accuracy/sweep/table.h"

namespace eddy::accuracy::sweep {

// What the pictures of plots.h have in common, as gnuplot reads it: a method has a colour, a grid a shape of point.

const char* colour_of(SolverPreset method);
/// Of grids that are drawn together, coarsest first.
int shape_of(const std::set<int>& grids, int cells);

std::set<int> grids_of(const Chosen& some);
/// Those of one method on one grid with the usual step and force, fewest iterations first.
Chosen line_of(const Chosen& some, SolverPreset method, int cells);

double time_of(const Measurement& m);     ///< of a step [ms]
double percent_of(const Measurement& m);  ///< its error
double share_of(const Measurement& m);    ///< the same, of 1
using Value = std::function<double(const Measurement&)>;

/// A line "x y" for each.
std::string data_of(const Chosen& some, const Value& x, const Value& y);

/// Data and the list of what one plot command draws.
class Plot {
  public:
    /// Adds a curve, if there is data; `title` empty: not in the key.
    void add(const std::string& data, const std::string& style, const std::string& title = "");
    /// A line of the key that stands for several curves.
    void explain(const std::string& style, const std::string& title);
    bool empty() const { return items_.empty(); }
    std::string text() const;

  private:
    void item(const std::string& text);

    std::string blocks_, items_;
    int count_ = 0;
};

/// The key: a line for each method and a point for each grid among these.
void explain_methods_and_grids(Plot& plot, const Chosen& some);
/// The steps below which nothing that was tried is as quick and as exact.
void add_front(Plot& plot, const Chosen& some, const Value& error);
/// A curve for each method and grid, along its iterations.
void add_curves_against_time(Plot& plot, const Chosen& some, const Value& error);
/// Those with other steps than usual, which lie on no curve.
void add_other_steps(Plot& plot, const Chosen& some, const Value& error);

extern const char* const kPercentAxis;
extern const char* const kTimeAxis;
/// Vertical lines at the time that a step may take at 20, 50 and 75 Hz.
std::string real_time_lines();
/// A logarithmic axis that ends a little beyond the least and the greatest value, and beyond `also`.
std::string range(const char* axis, const Chosen& some, const Value& value,
                  std::initializer_list<double> also = {});

}  // namespace eddy::accuracy::sweep
