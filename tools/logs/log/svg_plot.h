#pragma once
/// Plots as one SVG picture, one below the other over the same x axis. Pure.
#include <string>
#include <vector>

#include "tools/common/report/report.h"

namespace sprung::log {

struct SvgSize {
  int width = 1200;        ///< px
  int panel_height = 320;  ///< px of each plot
};

/// How high a picture of so many plots gets.
int svg_height(const SvgSize& size, std::size_t plots) noexcept;

/// Lines, shades and their names, axes with units, a legend. Bands, markers, clouds and equal axes are left
/// out: logs have none.
std::string to_svg(const std::string& title, const std::vector<report::Plot>& plots,
                   const SvgSize& size = {});

/// Round numbers of a scale that cover low..high, about `count` of them; low < high, both finite.
std::vector<double> round_ticks(double low, double high, int count);

}  // namespace sprung::log
