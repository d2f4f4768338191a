#pragma once
#include <cstddef>
#include <vector>

namespace eddy::gles {

/// A small dense system of linear equations, a x = b.
class LinearSystem {
  public:
    explicit LinearSystem(std::size_t unknowns) : n_(unknowns), a_(n_ * n_, 0.0), b_(n_, 0.0) {}

    std::size_t unknowns() const { return n_; }
    double& a(std::size_t row, std::size_t column) { return a_[row * n_ + column]; }
    double a(std::size_t row, std::size_t column) const { return a_[row * n_ + column]; }
    double& b(std::size_t row) { return b_[row]; }
    double b(std::size_t row) const { return b_[row]; }
    /// x, by elimination with the largest pivot of each column. The matrix must not be singular.
    std::vector<double> solve() const;

  private:
    std::size_t n_;
    std::vector<double> a_, b_;
};

}  // namespace eddy::gles
