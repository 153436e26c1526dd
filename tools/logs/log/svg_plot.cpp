#include "tools/logs/log/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "tools/common/report/html_text.h"

namespace sprung::log {

namespace {

constexpr int kTitleHeight = 40;
constexpr int kLeft = 80;    // px beside a panel, for the y axis
constexpr int kRight = 300;  // for the legend
constexpr int kTop = 26;
constexpr int kBottom = 34;
constexpr int kLineHeight = 15;
// Okabe and Ito's colours, which colour-blind readers tell apart.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000"};
constexpr const char* kShades[] = {"#dbe9f6", "#fbe5d6", "#ddf1e4", "#f3e3ef", "#fdf3d0", "#e4e4e4"};

template <class... Values>
std::string svg_format(const char* pattern, Values... values) {
  char line[240];
  std::snprintf(line, sizeof line, pattern, values...);
  return line;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Never empty, never without width.
  Range usable(double margin) const {
    if (!(low <= high)) return {0.0, 1.0};
    const double width = high > low ? high - low : std::max(1e-9, std::abs(high));
    return {low - margin * width, high + margin * width};
  }
};

Range x_range(const std::vector<report::Plot>& plots) {
  Range range;
  for (const report::Plot& plot : plots) {
    for (const report::Series& series : plot.series) {
      for (const double x : series.x) range.add(x);
    }
  }
  return range.usable(0.0);
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return svg_format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) +
         report::escape_html(text) + "</text>\n";
}

/// One plot's place on the picture.
class Panel {
 public:
  Panel(const report::Plot& plot, const Range& x, int index, const SvgSize& size)
      : plot_(plot),
        x_(x),
        left_(kLeft),
        right_(size.width - kRight),
        top_(kTitleHeight + index * size.panel_height + kTop),
        bottom_(kTitleHeight + (index + 1) * size.panel_height - kBottom) {
    Range y;
    for (const report::Series& series : plot.series) {
      for (const double value : series.y) y.add(value);
    }
    y_ = y.usable(0.05);
  }

  std::string svg(int index) const {
    std::string out = shades() + grid();
    out += svg_format(
        "<clipPath id=\"panel%d\"><rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/></clipPath>\n", index,
        left_, top_, right_ - left_, bottom_ - top_);
    out += svg_format("<g clip-path=\"url(#panel%d)\">\n", index);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) out += line(plot_.series[i], colour(i));
    return out + "</g>\n" + legend();
  }

 private:
  static const char* colour(std::size_t i) { return kColours[i % std::size(kColours)]; }
  double px(double x) const { return left_ + (x - x_.low) / (x_.high - x_.low) * (right_ - left_); }
  double py(double y) const { return bottom_ - (y - y_.low) / (y_.high - y_.low) * (bottom_ - top_); }

  std::string shades() const;
  std::string grid() const;
  std::string line(const report::Series& series, const char* stroke) const;
  std::string legend() const;

  const report::Plot& plot_;
  Range x_, y_;
  int left_, right_, top_, bottom_;
};

std::string Panel::shades() const {
  std::string out;
  std::map<std::string, std::size_t> colours;
  double free_from = left_;
  for (const report::Shade& shade : plot_.shades) {
    const std::size_t index = colours.emplace(shade.name, colours.size()).first->second;
    const double from = std::max<double>(px(shade.from), left_), to = std::min<double>(px(shade.to), right_);
    if (!(to > from)) continue;
    out +=
        svg_format("<rect class=\"shade\" x=\"%.1f\" y=\"%d\" width=\"%.1f\" height=\"%d\" fill=\"%s\"/>\n",
                   from, top_, to - from, bottom_ - top_, kShades[index % std::size(kShades)]);
    const double text_px = 7.0 * static_cast<double>(shade.name.size());
    if (from < free_from || to - from < text_px) continue;
    out += text_at(from + 3, top_ - 5, "start", shade.name);
    free_from = from + text_px;
  }
  return out;
}

std::string Panel::grid() const {
  std::string out = "<g stroke=\"#cccccc\" stroke-width=\"0.7\">\n", words;
  for (const double y : round_ticks(y_.low, y_.high, 6)) {
    out += svg_format("<line x1=\"%d\" y1=\"%.1f\" x2=\"%d\" y2=\"%.1f\"/>\n", left_, py(y), right_, py(y));
    words += text_at(left_ - 6, py(y) + 4, "end", svg_format("%g", y));
  }
  for (const double x : round_ticks(x_.low, x_.high, 10)) {
    out += svg_format("<line x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\"/>\n", px(x), top_, px(x), bottom_);
    words += text_at(px(x), bottom_ + 15, "middle", svg_format("%g", x));
  }
  words +=
      text_at(right_, bottom_ + 29, "end", plot_.x.label + (plot_.x.unit.empty() ? "" : ", " + plot_.x.unit));
  const std::string y_name =
      plot_.y.label + (plot_.y.label.empty() || plot_.y.unit.empty() ? "" : ", ") + plot_.y.unit;
  words += text_at(left_ - 6, top_ - 8, "end", y_name);
  words += text_at(left_, bottom_ + 29, "start", plot_.title);
  return out + "</g>\n" + words;
}

std::string Panel::line(const report::Series& series, const char* stroke) const {
  std::string out, path;
  const auto finish = [&] {
    if (!path.empty())
      out += svg_format("<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.2\" points=\"", stroke) +
             path + "\"/>\n";
    path.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
      path += svg_format("%.1f,%.1f ", px(series.x[i]), py(series.y[i]));
    } else {
      finish();
    }
  }
  finish();
  return out;
}

std::string Panel::legend() const {
  std::string out;
  const auto fits = static_cast<std::size_t>((bottom_ - top_) / kLineHeight);
  for (std::size_t i = 0; i < plot_.series.size(); ++i) {
    const int y = top_ + 10 + static_cast<int>(i) * kLineHeight;
    if (i + 1 == fits && plot_.series.size() > fits) {
      return out +
             text_at(right_ + 12, y, "start", "and " + std::to_string(plot_.series.size() - i) + " more");
    }
    out += svg_format("<line x1=\"%d\" y1=\"%d\" x2=\"%d\" y2=\"%d\" stroke=\"%s\" stroke-width=\"3\"/>\n",
                      right_ + 12, y - 4, right_ + 30, y - 4, colour(i));
    out += text_at(right_ + 36, y, "start", plot_.series[i].name);
  }
  return out;
}

}  // namespace

int svg_height(const SvgSize& size, std::size_t plots) noexcept {
  return kTitleHeight + size.panel_height * static_cast<int>(plots);
}

std::vector<double> round_ticks(double low, double high, int count) {
  const double raw = (high - low) / count;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  const double share = raw / decade;
  const double step = decade * (share > 5.0 ? 10.0 : share > 2.0 ? 5.0 : share > 1.0 ? 2.0 : 1.0);
  std::vector<double> ticks;
  // Multiples, not sums: no rounding adds up, and zero is zero.
  for (double n = std::ceil(low / step); n * step <= high && ticks.size() < 100; ++n)
    ticks.push_back(n * step + 0.0);
  return ticks;
}

std::string to_svg(const std::string& title, const std::vector<report::Plot>& plots, const SvgSize& size) {
  const int height = svg_height(size, plots.size());
  std::string out = svg_format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" ",
      size.width, height, size.width, height);
  out +=
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  out += "<g font-size=\"14\">" + text_at(kLeft, 22, "start", title) + "</g>\n";
  const Range x = x_range(plots);
  for (std::size_t i = 0; i < plots.size(); ++i)
    out += Panel(plots[i], x, static_cast<int>(i), size).svg(static_cast<int>(i));
  return out + "</svg>\n";
}

}  // namespace sprung::log
