#include "firmware/accuracy/convergence.h"

#include <cmath>

namespace eddy::accuracy {

std::optional<double> observed_order(double coarse_error, double fine_error, double coarse_h, double fine_h) {
    if (!(coarse_error > 0.0) || !(fine_error > 0.0) || coarse_h == fine_h) return std::nullopt;
    return std::log(coarse_error / fine_error) / std::log(coarse_h / fine_h);
}

std::optional<Extrapolation> extrapolate(const std::array<Result, 3>& finest_first) {
    const auto& [f1, f2, f3] = finest_first;
    const double share = (f3.value - f1.value) / (f2.value - f1.value);
    // (h3^p - h1^p) / (h2^p - h1^p) grows with p, from the ratio of the logarithms at p = 0.
    const auto of_order = [&](double p) {
        return (std::pow(f3.h / f1.h, p) - 1.0) / (std::pow(f2.h / f1.h, p) - 1.0);
    };
    double low = 0.1, high = 8.0;
    if (!(share > of_order(low)) || !(share < of_order(high))) return std::nullopt;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (of_order(middle) < share ? low : high) = middle;
    }
    const double change = (f1.value - f2.value) / (std::pow(f2.h / f1.h, low) - 1.0);
    return Extrapolation{f1.value + change, low, 1.25 * std::abs(change / f1.value)};
}

double worse(double a, double b) {
    return std::isnan(a) || a >= b ? a : b;
}

double linear_to_zero(const Result& a, const Result& b) {
    return a.value - a.h * (b.value - a.value) / (b.h - a.h);
}

}  // namespace eddy::accuracy
