#include "tools/logs/spy/spy_view.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "signals/number_text.h"
#include "tools/logs/fields/value_text.h"
#include "tools/logs/spy/plot_text.h"
#include "tools/logs/spy/topic_text.h"

namespace sprung::spy {

namespace {

constexpr std::size_t kPathWidth = 52;
constexpr std::size_t kValueWidth = 22;
constexpr std::size_t kUnitWidth = 8;
constexpr std::size_t kSparkWidth = 24;

std::string right(const std::string& text, std::size_t width) {
  return text.size() >= width ? fit(text, width) : std::string(width - text.size(), ' ') + text;
}

}  // namespace

SpyView::SpyView(ChannelBook& book, std::vector<fields::ListNames> names, std::string source)
    : book_(book), names_(std::move(names)), source_(std::move(source)) {}

void SpyView::Cursor::move(std::ptrdiff_t by, std::size_t count) {
  const auto last = static_cast<std::ptrdiff_t>(count) - 1;
  at = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(0, std::min(last, static_cast<std::ptrdiff_t>(at) + by)));
}

void SpyView::Cursor::keep_in_sight(std::size_t rows, std::size_t count) {
  move(0, count);
  top = std::min(top, at);
  if (at >= top + rows) top = at - rows + 1;
}

void SpyView::show_channel(const std::string& name) {
  channel_ = name;
  page_ = Page::kFields;
  field_cursor_ = {};
  follow(name);
}

bool SpyView::press(const KeyPress& press) {
  if (typing_filter_) {
    type(press);
    return true;
  }
  Cursor& cursor = page_ == Page::kChannels ? channel_cursor_ : field_cursor_;
  const auto page = static_cast<std::ptrdiff_t>(rows_);
  const std::size_t count = listed_.size();
  switch (press.key) {
    case Key::kUp:
      cursor.move(-1, count);
      break;
    case Key::kDown:
      cursor.move(1, count);
      break;
    case Key::kPageUp:
      cursor.move(-page, count);
      break;
    case Key::kPageDown:
      cursor.move(page, count);
      break;
    case Key::kHome:
      cursor.at = 0;
      break;
    case Key::kEnd:
      cursor.move(static_cast<std::ptrdiff_t>(count), count);
      break;
    case Key::kEnter:
      enter();
      break;
    case Key::kBack:
    case Key::kErase:
      back();
      break;
    case Key::kLetter:
      return command(press.letter);
    case Key::kNone:
      break;
  }
  return true;
}

void SpyView::type(const KeyPress& press) {
  if (press.key == Key::kLetter) filter_ += press.letter;
  if (press.key == Key::kErase && !filter_.empty()) filter_.pop_back();
  if (press.key == Key::kBack) filter_.clear();
  if (press.key == Key::kBack || press.key == Key::kEnter) typing_filter_ = false;
}

bool SpyView::command(char letter) {
  if (letter == 'q') return false;
  if (letter == ' ') pause_or_go_on();
  if (letter == 'j') return press({Key::kDown, 0});
  if (letter == 'k') return press({Key::kUp, 0});
  if (letter == '/' && page_ != Page::kPlot) {
    typing_filter_ = true;
    filter_.clear();
  }
  return true;
}

void SpyView::pause_or_go_on() {
  if (frozen_) return frozen_.reset();
  frozen_.emplace(book_);
  frozen_us_ = now_us_;
}

void SpyView::follow(const std::string& channel) {
  book_.follow(channel);
  if (frozen_) frozen_->follow(channel);
}

void SpyView::enter() {
  const Cursor& cursor = page_ == Page::kChannels ? channel_cursor_ : field_cursor_;
  if (cursor.at >= listed_.size() || page_ == Page::kPlot) return;
  const std::string chosen = listed_[cursor.at];
  if (page_ == Page::kChannels) {
    filter_.clear();
    show_channel(chosen);
  } else {
    field_ = chosen;
    page_ = Page::kPlot;
  }
}

void SpyView::back() {
  if (page_ == Page::kPlot) {
    page_ = Page::kFields;
  } else {
    filter_.clear();
    page_ = Page::kChannels;
    follow("");
  }
}

bool SpyView::passes(const std::string& text) const {
  return filter_.empty() || text.find(filter_) != std::string::npos;
}

std::vector<Line> SpyView::render(std::size_t width, std::size_t height, std::int64_t now_us) {
  now_us_ = now_us = frozen_ ? frozen_us_ : now_us;
  std::vector<Line> out;
  out.push_back({title(now_us), Style::kTitle});
  const std::size_t body = height > 3 ? height - 3 : 1;
  rows_ = body;
  if (page_ == Page::kChannels) {
    put_list(out, topic_heading(), channel_rows(now_us), channel_cursor_, body);
  } else if (page_ == Page::kFields) {
    put_list(out, fit("field", kPathWidth) + right("value", kValueWidth) + " unit", field_rows(),
             field_cursor_, body);
  } else {
    put_plot(out, width, body);
  }
  out.resize(std::max<std::size_t>(height, 1) - 1);
  out.push_back({footer(), Style::kFaint});
  for (Line& line : out) line.text = fit(line.text, width);
  return out;
}

void SpyView::put_list(std::vector<Line>& out, const std::string& heading, std::vector<Row> rows,
                       Cursor& cursor, std::size_t height) {
  listed_.clear();
  for (const Row& row : rows) listed_.push_back(row.key);
  cursor.keep_in_sight(height, rows.size());
  out.push_back({heading, Style::kFaint});
  if (rows.empty())
    out.push_back({filter_.empty() ? "nothing heard yet" : "nothing with '" + filter_ + "'", Style::kPlain});
  for (std::size_t i = cursor.top; i < std::min(rows.size(), cursor.top + height); ++i) {
    if (i == cursor.at) rows[i].line.style = Style::kSelected;
    out.push_back(std::move(rows[i].line));
  }
}

std::vector<SpyView::Row> SpyView::channel_rows(std::int64_t now_us) const {
  std::vector<Row> rows;
  for (const auto& [name, channel] : shown().channels()) {
    if (!passes(name)) continue;
    const bool trouble = channel.fault != fields::Fault::kNone || channel.gaps.counts().missing > 0;
    rows.push_back({name, 0, {topic_line(name, channel, now_us), trouble ? Style::kWarning : Style::kPlain}});
  }
  return rows;
}

std::vector<SpyView::Row> SpyView::field_rows() {
  std::vector<Row> rows;
  const Channel* const channel = shown().find(channel_);
  if (channel == nullptr || !shown().open_last(*channel, message_)) return rows;
  for (std::size_t i = 0; i < message_.fields().size(); ++i) {
    const fields::Field& field = message_.fields()[i];
    const std::string path = fields::with_names(field.path, names_);
    if (!passes(path)) continue;
    const bool number = field.kind != fields::Kind::kText && field.kind != fields::Kind::kBytes;
    std::string text = fit(path, kPathWidth);
    const std::string value = fields::value_text(message_, field);
    text += number ? right(value, kValueWidth) + " " + fit(field.unit, kUnitWidth) : "  " + value;
    rows.push_back({field.path, i, {text, Style::kPlain}});
  }
  // Only of what is in sight: the history of hundreds of fields would be read for nothing.
  field_cursor_.keep_in_sight(rows_, rows.size());
  for (std::size_t i = field_cursor_.top; i < std::min(rows.size(), field_cursor_.top + rows_); ++i) {
    const std::vector<double> values = shown().history().of(rows[i].field);
    if (range_of(values).known) rows[i].line.text += " " + sparkline(values, kSparkWidth);
  }
  return rows;
}

void SpyView::put_plot(std::vector<Line>& out, std::size_t width, std::size_t height) {
  const Channel* const channel = shown().find(channel_);
  if (channel == nullptr || !shown().open_last(*channel, message_)) return;
  const int index = message_.layout()->find(field_);
  if (index < 0) {
    out.push_back({field_ + " is not in the last message", Style::kWarning});
    return;
  }
  const fields::Field& field = message_.fields()[index];
  const std::vector<double> values = shown().history().of(static_cast<std::size_t>(index));
  const Range range = range_of(values);
  out.push_back({fields::with_names(field_, names_) + " = " + fields::value_text(message_, field) + " " +
                     field.unit + (field.member->comment.empty() ? "" : "   // " + field.member->comment),
                 Style::kPlain});
  if (!range.known) {
    out.push_back({"no numbers to plot", Style::kFaint});
    return;
  }
  const std::size_t lines = height > 3 ? height - 3 : 1;
  out.push_back({number_text(range.high, 5) + " " + field.unit, Style::kFaint});
  for (std::string& line : braille_plot(values, width, lines))
    out.push_back({std::move(line), Style::kPlain});
  out.push_back(
      {number_text(range.low, 5) + " " + field.unit + ", last 10 s, 50 samples a second", Style::kFaint});
}

std::string SpyView::title(std::int64_t now_us) const {
  std::string out = "sprung spy  " + source_;
  if (page_ == Page::kChannels) return out + (frozen_ ? "   PAUSED" : "");
  out += "  " + channel_;
  if (const Channel* const channel = shown().find(channel_)) {
    char text[96];
    const ChannelFigures figures = channel->statistics.figures(now_us);
    std::snprintf(text, sizeof text, "  %s  %.1f Hz  age %s", channel->type.c_str(), figures.rate_Hz,
                  age_text(figures.age_us).c_str());
    out += text;
    if (channel->fault != fields::Fault::kNone) out += std::string("  ") + name(channel->fault);
  }
  return out + (frozen_ ? "   PAUSED" : "");
}

std::string SpyView::footer() const {
  if (typing_filter_) return "show only what contains: " + filter_ + "_   (Enter keeps it, Esc drops it)";
  const std::string filter = filter_.empty() ? "" : "   [only '" + filter_ + "']";
  if (page_ == Page::kPlot) return "Left or Esc back   Space pause   q quit";
  return std::string("Up/Down move   Enter ") +
         (page_ == Page::kChannels ? "fields" : "plot   Left or Esc back") +
         "   / filter   Space pause   q quit" + filter;
}

}  // namespace sprung::spy
