#include "tools/common/report/plot_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/common/report/html_text.h"
#include "tools/common/report/thinning.h"

namespace sprung::report {

namespace {

using Json = nlohmann::ordered_json;

/// Numbers that are not finite are printed as null by the JSON library: a gap.
Json numbers(const Column& column, const std::vector<std::size_t>& kept) {
  return rounded_for_plot(pick(column, kept));
}

void require_as_long(const Plot& plot, const std::string& series, std::size_t x, std::size_t y) {
  if (x == y) return;
  throw std::invalid_argument("plot \"" + plot.title + "\", \"" + series + "\": " + std::to_string(x) +
                              " samples of x, " + std::to_string(y) + " of y");
}

/// -1 becomes the next colour that nobody in the plot asked for by number.
class Colours {
 public:
  explicit Colours(const Plot& plot) {
    for (const Series& series : plot.series) next_ = std::max(next_, series.colour + 1);
    for (const Band& band : plot.bands) next_ = std::max(next_, band.colour + 1);
  }
  int of(int asked) { return asked >= 0 ? asked : next_++; }

 private:
  int next_ = 0;
};

bool ascending(const Column& x) {
  return std::is_sorted(x.begin(), x.end()) &&
         std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

std::vector<std::size_t> samples_to_show(const Plot& plot, const Series& series) {
  if (series.style == Style::kPoints) return thin_cloud(series.x, series.y, plot.max_points);
  if (ascending(series.x)) return thin_in_order({&series.y}, plot.max_points);
  return thin_in_order({&series.x, &series.y}, plot.max_points);
}

Json series_json(const Plot& plot, const Series& series, int colour) {
  require_as_long(plot, series.name, series.x.size(), series.y.size());
  const std::vector<std::size_t> kept = samples_to_show(plot, series);
  return {{"name", series.name},        {"style", name(series.style)},  {"colour", colour},
          {"samples", series.x.size()}, {"x", numbers(series.x, kept)}, {"y", numbers(series.y, kept)}};
}

Json band_json(const Plot& plot, const Band& band, int colour) {
  require_as_long(plot, band.name, band.x.size(), band.low.size());
  require_as_long(plot, band.name, band.x.size(), band.high.size());
  const std::vector<std::size_t> kept = thin_in_order({&band.low, &band.high}, plot.max_points);
  return {{"name", band.name},
          {"colour", colour},
          {"samples", band.x.size()},
          {"x", numbers(band.x, kept)},
          {"low", numbers(band.low, kept)},
          {"high", numbers(band.high, kept)}};
}

std::string axis_text(const Axis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")";
}

Json plot_json(const Plot& plot) {
  Json json = {{"x", axis_text(plot.x)}, {"y", axis_text(plot.y)}, {"equal", plot.equal_axes}};
  for (const char* list : {"series", "bands", "shades", "markers"}) json[list] = Json::array();
  Colours colours(plot);
  for (const Series& series : plot.series) {
    json["series"].push_back(series_json(plot, series, colours.of(series.colour)));
  }
  for (const Band& band : plot.bands) {
    json["bands"].push_back(band_json(plot, band, colours.of(band.colour)));
  }
  for (const Shade& shade : plot.shades) {
    json["shades"].push_back({{"from", shade.from}, {"to", shade.to}, {"name", shade.name}});
  }
  for (const Marker& marker : plot.markers) {
    json["markers"].push_back({{"x", marker.x}, {"name", marker.name}});
  }
  return json;
}

}  // namespace

std::string plots_json(const std::vector<const Plot*>& plots) {
  Json list = Json::array();
  for (const Plot* plot : plots) list.push_back(plot_json(*plot));
  return escape_script(list.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace sprung::report
