#pragma once
/// Which samples a screen can show: a plot is about 1000 pixels wide, a log of ten minutes has 600 000
/// samples.
#include <cstddef>
#include <vector>

namespace sprung::report {

using Column = std::vector<double>;

/// For samples in order. Cuts them into equal stretches; each keeps where every column is lowest and highest,
/// so that no peak is lost, and one sample that is not finite, so that no gap is bridged. First and last
/// stay. Columns are equally long.
/// @return ascending indices, about max_points of them; all of them if there are no more than that.
std::vector<std::size_t> thin_in_order(const std::vector<const Column*>& columns, std::size_t max_points);

/// For a cloud of points: half of them evenly in order, which shows where the cloud is dense, half one of
/// each cell of a grid over what they span, which keeps what lies apart, and the outermost points. Points
/// that are not finite are left out.
/// @return ascending indices, at most max_points + 4.
std::vector<std::size_t> thin_cloud(const Column& x, const Column& y, std::size_t max_points);

/// The chosen samples.
Column pick(const Column& values, const std::vector<std::size_t>& indices);

}  // namespace sprung::report
