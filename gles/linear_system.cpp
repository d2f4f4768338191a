#include "gles/linear_system.h"

#include <cmath>
#include <utility>

namespace eddy::gles {

std::vector<double> LinearSystem::solve() const {
    LinearSystem s = *this;
    for (std::size_t k = 0; k < n_; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n_; ++i)
            if (std::abs(s.a(i, k)) > std::abs(s.a(pivot, k))) pivot = i;
        for (std::size_t j = 0; j < n_; ++j) std::swap(s.a(k, j), s.a(pivot, j));
        std::swap(s.b(k), s.b(pivot));
        for (std::size_t i = k + 1; i < n_; ++i) {
            const double factor = s.a(i, k) / s.a(k, k);
            for (std::size_t j = k; j < n_; ++j) s.a(i, j) -= factor * s.a(k, j);
            s.b(i) -= factor * s.b(k);
        }
    }
    std::vector<double> x(n_);
    for (std::size_t k = n_; k-- > 0;) {
        double rest = s.b(k);
        for (std::size_t j = k + 1; j < n_; ++j) rest -= s.a(k, j) * x[j];
        x[k] = rest / s.a(k, k);
    }
    return x;
}

}  // namespace eddy::gles
