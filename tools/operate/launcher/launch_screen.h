#pragma once
/// What `sprung up` shows in a terminal: one screen, drawn anew several times a second. Pure: values in,
/// lines out.
#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "tools/operate/launcher/log_lines.h"
#include "tools/operate/launcher/status_board.h"

namespace sprung {

struct ScreenContent {
  std::string robot;
  std::string phase;  ///< "starting", "up", "stopping"
  std::string facts;  ///< clock, preset, network
  std::string log;    ///< its file; "" = none
  std::string safety;
  bool safety_bad = false;
  double up_s = 0.0;
  std::vector<ProcessRow> rows;
  std::string hint;  ///< what to type next
};

enum class LineStyle { kPlain, kHeading, kBad, kDim };
struct ScreenLine {
  std::string text;  ///< one byte a column
  LineStyle style = LineStyle::kPlain;
};

/// At most `height` lines of at most `width` columns: heading, table, the newest log lines in what is left,
/// the hint last. The table has 80 columns; longer lines go on in the next one.
std::vector<ScreenLine> launch_screen(const ScreenContent& content, const std::deque<LogLine>& log,
                                      std::size_t width, std::size_t height);

}  // namespace sprung
