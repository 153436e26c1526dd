#pragma once
/// A report for people: one HTML file that opens from disk, with tables and plots that can be zoomed. Pure:
/// structs in, text out; tools/common/report/report_shell.h writes the file. The same report gives the same
/// bytes: put date and version in as text.
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "signals/enumeration.h"

namespace sprung::report {

/// Five significant digits, as tables show numbers; "-" where it is not finite.
std::string number_text(double value);
/// For tables of what is known to more digits than anyone needs.
double hundredths(double value);

enum class Mark { kPlain, kGood, kBad };  ///< kGood and kBad are shown by colour and by a sign

/// One cell of a table: text, or a number as number_text() writes it.
struct Cell {
  std::string text;
  Mark mark = Mark::kPlain;
  std::string link{};  ///< a page beside this one, or "#...": the text leads there; empty: nowhere

  Cell(std::string text_in, Mark mark_in = Mark::kPlain) : text(std::move(text_in)), mark(mark_in) {}
  Cell(const char* text_in, Mark mark_in = Mark::kPlain) : text(text_in), mark(mark_in) {}
  template <typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
  Cell(Number value, Mark mark_in = Mark::kPlain)
      : text(number_text(static_cast<double>(value))), mark(mark_in) {}
};

struct Table {
  std::string title;                         ///< may be empty
  std::vector<std::string> columns;          ///< unit in the heading: "RMS (Nm)"
  std::vector<std::vector<Cell>> rows = {};  ///< each as long as `columns`
  std::string note{};                        ///< below the table; may be empty
  bool folded = false;                       ///< shown as one line to click on: long lists of parameters
};

struct Axis {
  std::string label;
  std::string unit{};  ///< empty: no unit is printed
};

enum class Style {
  kLine,        ///< samples joined in the order given; a NaN in x or y is a gap
  kDashedLine,  ///< for what is wanted, predicted or fitted
  kPoints,      ///< a cloud: the order means nothing
};
constexpr auto words_of(Style) {
  using E = Style;
  return words<E>({{E::kLine, "line"}, {E::kDashedLine, "dashed"}, {E::kPoints, "points"}});
}

/// Dashed lines lie on top, then lines, clouds and bands; among their like the first is on top. Colours are
/// told apart by colour-blind readers; series of one `colour` belong together ("knee, measured" and "knee,
/// estimated").
struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< as long as x
  Style style = Style::kLine;
  int colour = -1;  ///< any number from 0, same number same colour; -1: the next one that nobody named
};

/// The area between two curves over x, such as the bounds of an estimate.
struct Band {
  std::string name;
  std::vector<double> x;  ///< ascending
  std::vector<double> low;
  std::vector<double> high;
  int colour = -1;  ///< as in Series: the number of the line that it belongs to
};

/// A stretch of x with a name, such as a phase; stretches of one name have one colour.
struct Shade {
  double from;
  double to;
  std::string name;
};

/// A moment with a name: an upright line.
struct Marker {
  double x;
  std::string name;
};

struct Plot {
  std::string title;
  Axis x;
  Axis y;
  std::vector<Series> series = {};
  std::vector<Band> bands = {};
  std::vector<Shade> shades = {};
  std::vector<Marker> markers = {};
  bool equal_axes = false;  ///< one unit is as long in x as in y (path of a foot)
  std::string note{};       ///< below the plot: what the reader should see
  /// A series with more samples is thinned to about as many: each stretch keeps its lowest and its highest,
  /// and gaps stay.
  std::size_t max_points = 3000;
};

/// Texts come first, then tables, then plots. Plots of one section with the same x axis are zoomed together.
struct Section {
  std::string heading;
  std::vector<std::string> text = {};  ///< paragraphs, plain text
  std::vector<Table> tables = {};
  std::vector<Plot> plots = {};
};

struct Report {
  std::string title;
  std::string subtitle{};  ///< robot, preset, seed, version, date
  std::string command{};   ///< the line that makes this report again
  std::vector<Section> sections = {};
};

/// The whole file. @throws std::invalid_argument where columns or samples are not equally many, naming the
/// place.
std::string to_html(const Report& report);

/// Plots as data for tools/common/report/report.js, thinned: a JSON array, safe inside a <script>; what is
/// not finite becomes null.
/// @throws std::invalid_argument where x and y are not equally long, naming plot and series.
std::string plots_json(const std::vector<const Plot*>& plots);

}  // namespace sprung::report
