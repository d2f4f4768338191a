#include "gles/linear_system.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eddy::gles {
namespace {

/// Of Hilbert's kind, but well conditioned: 1 / (1 + |i - j|), rows in another order so that pivots must be looked for.
LinearSystem sample(std::size_t n) {
    LinearSystem s(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            s.a(i, j) = 1.0 / (1.0 + std::abs(static_cast<double>((i + 2) % n) - static_cast<double>(j)));
    return s;
}

TEST(LinearSystem, FindsTheUnknownsItWasMadeFrom) {
    for (const std::size_t n : {1u, 2u, 6u, 12u}) {
        LinearSystem s = sample(n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) s.b(i) += s.a(i, j) * (1.0 + static_cast<double>(j));
        const std::vector<double> x = s.solve();
        for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(x[j], 1.0 + static_cast<double>(j), 1e-12 * n);
    }
}

TEST(LinearSystem, SwapsRowsWhereTheDiagonalIsZero) {
    LinearSystem s(2);
    s.a(0, 1) = 2.0;
    s.a(1, 0) = 4.0;
    s.b(0) = 6.0;
    s.b(1) = 8.0;
    EXPECT_EQ(s.solve(), (std::vector<double>{2.0, 3.0}));
}

}  // namespace
}  // namespace eddy::gles
