#include "tools/common/report/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sprung_embedded/report_chart_library.h"
#include "sprung_embedded/report_script.h"
#include "sprung_embedded/report_style.h"
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

constexpr std::size_t kSectionsWithoutContents = 2;

/// Nothing is fetched, whatever a text in the report says.
const char kPolicy[] =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'; img-src data:\">\n";

std::string element(const std::string& tag, const std::string& css_class, const std::string& text) {
  if (text.empty()) return "";
  return "<" + tag + " class=\"" + css_class + "\">" + escape_html(text) + "</" + tag + ">\n";
}

std::vector<bool> numeric_columns(const Table& table) {
  std::vector<bool> numeric(table.columns.size(), !table.rows.empty());
  for (const std::vector<Cell>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw std::invalid_argument("table \"" + table.title + "\": a row of " + std::to_string(row.size()) +
                                  " cells under " + std::to_string(table.columns.size()) + " columns");
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      numeric[i] = numeric[i] && (row[i].text.empty() || looks_numeric(row[i].text));
    }
  }
  return numeric;
}

std::string cell_html(const char* tag, const Cell& cell, bool numeric) {
  std::string css_class = numeric ? "number" : "";
  if (cell.mark != Mark::kPlain) css_class += cell.mark == Mark::kGood ? " good" : " bad";
  const std::string attribute = css_class.empty() ? "" : " class=\"" + css_class + "\"";
  std::string text = escape_html(cell.text);
  if (!cell.link.empty()) text = "<a href=\"" + escape_html(cell.link) + "\">" + text + "</a>";
  return std::string("<") + tag + attribute + ">" + text + "</" + tag + ">";
}

std::string grid_html(const Table& table) {
  const std::vector<bool> numeric = numeric_columns(table);
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    html += cell_html("th", table.columns[i], numeric[i]);
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<Cell>& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) html += cell_html("td", row[i], numeric[i]);
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string table_html(const Table& table) {
  const std::string body = grid_html(table) + element("p", "note", table.note);
  if (!table.folded) {
    return "<figure>\n" + element("figcaption", "title", table.title) + body + "</figure>\n";
  }
  const std::string title = table.title.empty() ? "Table" : table.title;
  return "<figure><details>\n" + element("summary", "title", title) + body + "</details></figure>\n";
}

/// `number` is the plot's place in the data.
std::string plot_html(const Plot& plot, std::size_t number) {
  const std::string box = plot.equal_axes ? "canvas equal" : "canvas";
  return "<figure>\n" + element("figcaption", "title", plot.title) + "<div class=\"" + box +
         "\"><canvas data-plot=\"" + std::to_string(number) + "\" role=\"img\" aria-label=\"" +
         escape_html(plot.title) + "\"></canvas></div>\n" + element("p", "note", plot.note) + "</figure>\n";
}

std::string anchor(std::size_t section) { return "section" + std::to_string(section + 1); }

std::string contents_html(const Report& report) {
  if (report.sections.size() <= kSectionsWithoutContents) return "";
  std::string html = "<nav><ul>\n";
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    html += "<li><a href=\"#" + anchor(i) + "\">" + escape_html(report.sections[i].heading) + "</a></li>\n";
  }
  return html + "</ul></nav>\n";
}

std::string header_html(const Report& report, bool has_plots) {
  std::string html = "<header>\n<h1>" + escape_html(report.title) + "</h1>\n";
  html += element("p", "subtitle", report.subtitle);
  if (!report.command.empty()) {
    html += "<p class=\"command\">Made by <code>" + escape_html(report.command) + "</code></p>\n";
  }
  if (has_plots) {
    html +=
        "<p class=\"hint\">Plots: drag to look closer, double-click to see all, click a name in a legend to "
        "hide it, point at a curve to read it.</p>\n<noscript><p>The plots need JavaScript.</p></noscript>\n";
  }
  return html + "</header>\n" + contents_html(report);
}

/// Appends the section's plots to `plots`, in the order of the page.
std::string section_html(const Section& section, std::size_t number, std::vector<const Plot*>& plots) {
  std::string html = "<section id=\"" + anchor(number) + "\">\n";
  html += element("h2", "heading", section.heading);
  for (const std::string& paragraph : section.text) html += element("p", "text", paragraph);
  for (const Table& table : section.tables) html += table_html(table);
  for (const Plot& plot : section.plots) {
    html += plot_html(plot, plots.size());
    plots.push_back(&plot);
  }
  return html + "</section>\n";
}

std::string scripts_html(const std::vector<const Plot*>& plots) {
  if (plots.empty()) return "";
  return "<script type=\"application/json\" id=\"plots\">" + plots_json(plots) + "</script>\n<script>" +
         report_chart_library() + "</script>\n<script>" + report_script() + "</script>\n";
}

}  // namespace

std::string plots_json(const std::vector<const Plot*>& plots) {
  Json list = Json::array();
  for (const Plot* plot : plots) list.push_back(plot_json(*plot));
  return escape_script(list.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string to_html(const Report& report) {
  std::vector<const Plot*> plots;
  std::string body;
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    body += section_html(report.sections[i], i, plots);
  }
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + std::string(kPolicy) +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escape_html(report.title) + "</title>\n<style>\n" + report_style() +
         "</style>\n</head>\n<body>\n<main>\n" + header_html(report, !plots.empty()) + body + "</main>\n" +
         scripts_html(plots) + "</body>\n</html>\n";
}

}  // namespace sprung::report
