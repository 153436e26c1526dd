#pragma once
/// A small strictly convex quadratic program: smallest 1/2 x'Cx + g'x with rows n.x >= b that touch one
/// foot's force each. Dual active-set method of Goldfarb and Idnani (Math. Programming 27, 1983): starts at
/// the unconstrained minimum, which is the answer when no row is violated, and adds one violated row after
/// the other. It needs no feasible start, and rows that meet in one point (a foot without load) don't make it
/// cycle. Pure; all of it lies on the stack or in the object.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>

namespace sprung {

class ForceDistributionQp {
 public:
  static constexpr int kVariables = 12;
  static constexpr int kMostRows = 40;
  using Vector = Eigen::Matrix<double, kVariables, 1>;
  using Matrix = Eigen::Matrix<double, kVariables, kVariables>;

  /// normal . x[first .. first + 2] >= least
  struct Row {
    int first = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double least = 0.0;
  };

  /// A new problem without rows in the first `variables` numbers; the others are 0, and no row may be about
  /// them. Only the lower triangle of `cost` is read; it must be positive definite.
  void begin(const Matrix& cost, const Vector& gradient, int variables = kVariables) noexcept;
  /// Beyond kMostRows it is not taken, and false comes back.
  bool add(const Row& row) noexcept;

  /// False where the rows contradict each other, `cost` is not positive definite, or kMostSteps were not
  /// enough.
  bool solve() noexcept;

  /// After solve(): no row is violated by more than kTolerance.
  const Vector& solution() const noexcept { return x_; }
  /// How often a row was taken in or let go.
  int steps() const noexcept { return steps_; }
  /// Price of a row (Lagrange multiplier), 0 where it is not active.
  double price(int row) const noexcept;

  static constexpr double kTolerance = 1e-7;  ///< N, where rows are about forces
  static constexpr int kMostSteps = 200;      ///< of 3000 random problems the worst takes 38

 private:
  struct Direction {
    Vector coordinates;         ///< of the new row's normal in the basis of the active ones
    Vector rest;                ///< what of it they don't span
    Vector prices;              ///< how fast theirs fall as the new row's rises
    double rest_squared = 0.0;  ///< 0 where the normal depends on the active ones
  };

  double excess(const Row& row) const noexcept {
    return row.normal.dot(x_.segment<3>(row.first)) - row.least;
  }
  int most_violated() const noexcept;
  bool enforce(int row) noexcept;
  Vector scaled_normal(int row) const noexcept;
  Direction direction(const Vector& normal) const noexcept;
  int first_to_leave(const Direction& along, double& length) const noexcept;
  void take_in(int row, double price, const Direction& along) noexcept;
  void let_go(int place) noexcept;

  using Part = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kVariables, kVariables>;

  int variables_ = 0;
  Eigen::LLT<Part> cost_;  ///< of the first `variables_` rows
  Vector x_ = Vector::Zero();
  std::array<Row, kMostRows> rows_;
  int row_count_ = 0;
  std::array<int, kVariables> active_{};  ///< rows, in the order in which they came
  int active_count_ = 0;
  Vector prices_ = Vector::Zero();  ///< of the active rows
  Matrix basis_ = Matrix::Zero();   ///< orthonormal columns: the active rows' scaled normals are basis_ *
                                    ///< triangle_
  Matrix triangle_ = Matrix::Zero();
  int steps_ = 0;
};

}  // namespace sprung
