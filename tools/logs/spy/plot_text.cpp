#include "tools/logs/spy/plot_text.h"

#include <algorithm>
#include <cmath>

namespace sprung::spy {

namespace {

/// U+0800 to U+FFFF: all that is needed here.
std::string utf8(unsigned code) {
  return {static_cast<char>(0xE0U | (code >> 12U)), static_cast<char>(0x80U | ((code >> 6U) & 0x3FU)),
          static_cast<char>(0x80U | (code & 0x3FU))};
}

/// 0 at the bottom, steps - 1 at the top.
std::size_t height_of(double value, const Range& range, std::size_t steps) {
  if (range.high <= range.low) return 0;
  const double share = (value - range.low) / (range.high - range.low);
  return std::min(steps - 1, static_cast<std::size_t>(share * static_cast<double>(steps)));
}

/// Smallest and largest of the values that fall on one column of `columns`, and of the last one before them.
Range column_range(const std::vector<double>& values, std::size_t column, std::size_t columns) {
  std::size_t begin = column * values.size() / columns;
  const std::size_t end = std::max(begin + 1, (column + 1) * values.size() / columns);
  if (begin > 0 && std::isfinite(values[begin])) --begin;  // joined to the column before, but across a gap
  return range_of({values.begin() + static_cast<std::ptrdiff_t>(begin),
                   values.begin() + static_cast<std::ptrdiff_t>(std::min(end, values.size()))});
}

}  // namespace

Range range_of(const std::vector<double>& values) noexcept {
  Range out;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    out.low = out.known ? std::min(out.low, value) : value;
    out.high = out.known ? std::max(out.high, value) : value;
    out.known = true;
  }
  return out;
}

std::string sparkline(const std::vector<double>& values, std::size_t width) {
  constexpr unsigned kLowestBlock = 0x2581;
  constexpr std::size_t kBlocks = 8;
  const std::size_t shown = std::min(width, values.size());
  const std::vector<double> newest(values.end() - static_cast<std::ptrdiff_t>(shown), values.end());
  const Range range = range_of(newest);
  std::string out(width - shown, ' ');
  for (const double value : newest)
    out += std::isfinite(value) ? utf8(kLowestBlock + static_cast<unsigned>(height_of(value, range, kBlocks)))
                                : " ";
  return out;
}

std::vector<std::string> braille_plot(const std::vector<double>& values, std::size_t width,
                                      std::size_t height) {
  constexpr unsigned kEmpty = 0x2800;
  constexpr unsigned kDots[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
  std::vector<std::vector<unsigned>> cells(height, std::vector<unsigned>(width, kEmpty));
  const Range all = range_of(values);
  for (std::size_t column = 0; column < 2 * width && all.known; ++column) {
    const Range here = column_range(values, column, 2 * width);
    if (!here.known) continue;
    for (std::size_t dot = height_of(here.low, all, 4 * height); dot <= height_of(here.high, all, 4 * height);
         ++dot) {
      const std::size_t from_top = 4 * height - 1 - dot;
      cells[from_top / 4][column / 2] |= kDots[from_top % 4][column % 2];
    }
  }
  std::vector<std::string> out(height);
  for (std::size_t row = 0; row < height; ++row) {
    for (const unsigned cell : cells[row]) out[row] += utf8(cell);
  }
  return out;
}

std::string fit(const std::string& utf8, std::size_t width) {
  const auto begins_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  const auto letters = static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), begins_letter));
  if (letters <= width) return utf8 + std::string(width - letters, ' ');
  if (width == 0) return "";
  std::size_t end = 0;
  for (std::size_t left = width; end < utf8.size() && !(begins_letter(utf8[end]) && left-- == 1);) ++end;
  return utf8.substr(0, end) + "~";
}

}  // namespace sprung::spy
