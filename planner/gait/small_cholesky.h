#pragma once
/// A = L L' of a symmetric positive definite matrix of a few rows, `Most` at the most, of which the first `size` count. Plain loops: for
/// a dozen rows and fewer Eigen's factors, made for matrices of any size, take several times as long. Pure, no heap.
#include <Eigen/Core>
#include <cmath>

namespace sprung {

template <int Most>
class SmallCholesky {
 public:
  using Vector = Eigen::Matrix<double, Most, 1>;
  using Matrix = Eigen::Matrix<double, Most, Most>;

  /// Only the lower triangle is read. @return false unless the matrix is positive definite; then nothing can be solved.
  bool factorize(const Matrix& a, int size) noexcept {
    size_ = size;
    for (int j = 0; j < size_; ++j) {
      double left = a(j, j);
      for (int k = 0; k < j; ++k) left -= lower_(j, k) * lower_(j, k);
      if (!(left > 0.0)) return false;
      lower_(j, j) = std::sqrt(left);
      for (int i = j + 1; i < size_; ++i) {
        double value = a(i, j);
        for (int k = 0; k < j; ++k) value -= lower_(i, k) * lower_(j, k);
        lower_(i, j) = value / lower_(j, j);
      }
    }
    return true;
  }

  /// To L^-1 x.
  void forward(Vector& x) const noexcept {
    for (int i = 0; i < size_; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= lower_(i, k) * x[k];
      x[i] /= lower_(i, i);
    }
  }

  /// To L'^-1 x.
  void backward(Vector& x) const noexcept {
    for (int i = size_ - 1; i >= 0; --i) {
      for (int k = i + 1; k < size_; ++k) x[i] -= lower_(k, i) * x[k];
      x[i] /= lower_(i, i);
    }
  }

 private:
  Matrix lower_ = Matrix::Zero();
  int size_ = 0;
};

}  // namespace sprung
