#pragma once
/// Plots in letters: blocks in one line, Braille dots in several. UTF-8. Pure.
#include <cstddef>
#include <string>
#include <vector>

namespace sprung::spy {

struct Range {
  double low = 0.0;
  double high = 0.0;
  bool known = false;  ///< false where no value is finite
};
Range range_of(const std::vector<double>& values) noexcept;

/// The newest values at the right, `width` letters of eight heights; a value that never changes is a low
/// line, NaN a gap.
std::string sparkline(const std::vector<double>& values, std::size_t width);

/// Lines from top to bottom, each of `width` letters of 2 x 4 dots; all values over the whole width.
std::vector<std::string> braille_plot(const std::vector<double>& values, std::size_t width,
                                      std::size_t height);

/// Cut or padded with blanks to `width` letters (code points); one that was cut ends in "~".
std::string fit(const std::string& utf8, std::size_t width);

}  // namespace sprung::spy
