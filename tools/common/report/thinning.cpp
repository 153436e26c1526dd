#include "tools/common/report/thinning.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace sprung::report {

namespace {

using Indices = std::vector<std::size_t>;

/// A plot's points are drawn about 4 pixels wide on about 1000 x 250 pixels.
constexpr std::size_t kFinestGridColumns = 250;
constexpr std::size_t kColumnsPerRow = 4;

void sort_unique(Indices& indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

/// Adds where the column is lowest and highest in [begin, end), and its first sample that is not finite.
void add_extremes(const Column& column, std::size_t begin, std::size_t end, Indices& kept) {
  std::size_t low = end, high = end, gap = end;
  for (std::size_t i = begin; i < end; ++i) {
    if (!std::isfinite(column[i])) {
      gap = std::min(gap, i);
      continue;
    }
    if (low == end || column[i] < column[low]) low = i;
    if (high == end || column[i] > column[high]) high = i;
  }
  for (const std::size_t index : {low, high, gap}) {
    if (index != end) kept.push_back(index);
  }
}

/// Of the finite points.
struct Span {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// 0 ... cells - 1
  std::size_t cell(double value, std::size_t cells) const {
    if (!(high > low)) return 0;
    const double part = value / (high - low) - low / (high - low);
    return std::min(cells - 1, static_cast<std::size_t>(std::max(0.0, part) * static_cast<double>(cells)));
  }
};

Indices finite_points(const Column& x, const Column& y) {
  Indices finite;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i])) finite.push_back(i);
  }
  return finite;
}

/// The first point of each cell.
Indices first_of_cells(const Column& x, const Column& y, const Indices& points, std::size_t grid_columns) {
  const std::size_t grid_rows = std::max<std::size_t>(1, grid_columns / kColumnsPerRow);
  Span x_span, y_span;
  for (const std::size_t i : points) x_span.add(x[i]), y_span.add(y[i]);
  std::vector<bool> taken(grid_columns * grid_rows, false);
  Indices kept;
  for (const std::size_t i : points) {
    const std::size_t cell = x_span.cell(x[i], grid_columns) * grid_rows + y_span.cell(y[i], grid_rows);
    if (!taken[cell]) kept.push_back(i);
    taken[cell] = true;
  }
  return kept;
}

/// Of the finest grid that gives no more than max_points.
Indices one_of_each_cell(const Column& x, const Column& y, const Indices& points, std::size_t max_points) {
  std::size_t grid_columns = kFinestGridColumns;
  Indices kept = first_of_cells(x, y, points, grid_columns);
  while (kept.size() > max_points && grid_columns > 1) {
    grid_columns = grid_columns * 3 / 4;
    kept = first_of_cells(x, y, points, grid_columns);
  }
  return kept;
}

/// One somewhere in each of `count` stretches: always the first would fall in step with a periodic signal.
void add_evenly(const Indices& points, std::size_t count, Indices& kept) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = points.size() * i / count, end = points.size() * (i + 1) / count;
    const std::uint64_t mixed = (i * 0x9E3779B97F4A7C15ull) >> 40;  // golden ratio hashing
    if (begin < end) kept.push_back(points[begin + mixed % (end - begin)]);
  }
}

void add_outermost(const Column& column, const Indices& points, Indices& kept) {
  const auto less = [&column](std::size_t a, std::size_t b) { return column[a] < column[b]; };
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
  kept.push_back(*low);
  kept.push_back(*high);
}

}  // namespace

Indices thin_in_order(const std::vector<const Column*>& columns, std::size_t max_points) {
  const std::size_t count = columns.front()->size();
  Indices kept;
  if (count <= max_points) {
    kept.resize(count);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  const std::size_t stretches = std::max<std::size_t>(1, max_points / (2 * columns.size()));
  kept = {0, count - 1};
  for (std::size_t i = 0; i < stretches; ++i) {
    for (const Column* column : columns) {
      add_extremes(*column, count * i / stretches, count * (i + 1) / stretches, kept);
    }
  }
  sort_unique(kept);
  return kept;
}

Indices thin_cloud(const Column& x, const Column& y, std::size_t max_points) {
  Indices finite = finite_points(x, y);
  if (finite.size() <= max_points) return finite;
  const std::size_t half = std::max<std::size_t>(1, max_points / 2);
  Indices kept = one_of_each_cell(x, y, finite, half);
  add_evenly(finite, half, kept);
  add_outermost(x, finite, kept);
  add_outermost(y, finite, kept);
  sort_unique(kept);
  return kept;
}

Column pick(const Column& values, const Indices& indices) {
  Column picked;
  picked.reserve(indices.size());
  for (const std::size_t index : indices) picked.push_back(values[index]);
  return picked;
}

}  // namespace sprung::report
