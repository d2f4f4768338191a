#pragma once
#include <array>
#include <optional>

namespace eddy::accuracy {

/// p in e ~ h^p, from the errors on two grids. None where an error is zero or the widths are equal.
std::optional<double> observed_order(double coarse_error, double fine_error, double coarse_h, double fine_h);

/// A result on a grid.
struct Result {
    double h;  ///< width of a cell, in any unit
    double value;
};

/// What three grids say of the grid that has no error.
struct Extrapolation {
    double value;  ///< Richardson's, at h = 0
    double order;  ///< p in value(h) = value + c h^p
    double gci;    ///< grid convergence index of the finest: 1.25 |f2 - f1| / (|f1| (r^p - 1))
};

/// Roache 1994; Celik et al. 2008 for widths in any ratio. Finest first. None where the results do not approach one
/// value from one side, or slower than h^0.1 or faster than h^8: three grids then say nothing.
std::optional<Extrapolation> extrapolate(const std::array<Result, 3>& finest_first);

/// The greater of two errors; not a number if either is none.
double worse(double a, double b);

/// The value at x = 0 of the straight line through two results.
double linear_to_zero(const Result& a, const Result& b);

}  // namespace eddy::accuracy
