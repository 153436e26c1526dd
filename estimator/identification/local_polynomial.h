#pragma once
/// Savitzky-Golay smoothing and derivatives: a polynomial is fitted to the samples around each sample and
/// read off there. No phase lag; at the ends the window is cut off and the polynomial read off at its edge.
/// Pure.
#include <Eigen/Core>

namespace sprung::identification {

/// @param half_width samples on each side, >= 1.
/// @param degree of the polynomial, >= derivative; lowered where a window has fewer samples.
/// @param derivative 0 = the smoothed signal; n = nth derivative by time.
/// @throws std::invalid_argument when the signal has not more samples than `derivative`.
Eigen::VectorXd local_polynomial(const Eigen::VectorXd& signal, double period_s, int half_width, int degree,
                                 int derivative);

}  // namespace sprung::identification
