#pragma once
/// The screens of `sprung spy` and what keys do in them: a table of channels, the fields of one, the plot of
/// one field. Pure: text in lines comes out; spy_shell.h puts it on a terminal.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/logs/fields/field_choice.h"
#include "tools/logs/spy/channel_book.h"

namespace sprung::spy {

enum class Key : std::int8_t {
  kNone,
  kUp,
  kDown,
  kPageUp,
  kPageDown,
  kHome,
  kEnd,
  kEnter,
  kBack,
  kErase,
  kLetter
};

struct KeyPress {
  Key key = Key::kNone;
  char letter = 0;  ///< of kLetter
};

enum class Style : std::int8_t { kPlain, kTitle, kSelected, kWarning, kFaint };

struct Line {
  std::string text;  ///< UTF-8, no wider than the screen
  Style style = Style::kPlain;
};

class SpyView {
 public:
  /// @param book outlives this. @param names see fields::with_names. @param source what is listened to, for
  /// the title.
  SpyView(ChannelBook& book, std::vector<fields::ListNames> names, std::string source);

  /// Shows this channel's fields at once, as soon as it is heard.
  void show_channel(const std::string& name);
  /// @return false when the user wants to leave.
  bool press(const KeyPress& press);
  /// Exactly `height` lines. Shows what was there when the user paused, while the book goes on. @param now_us
  /// on the clock of the arrivals.
  std::vector<Line> render(std::size_t width, std::size_t height, std::int64_t now_us);

 private:
  enum class Page : std::int8_t { kChannels, kFields, kPlot };
  /// A list with a cursor that stays in sight.
  struct Cursor {
    std::size_t at = 0;
    std::size_t top = 0;
    void move(std::ptrdiff_t by, std::size_t count);
    void keep_in_sight(std::size_t rows, std::size_t count);
  };
  struct Row {
    std::string key;  ///< channel, or path
    std::size_t field = 0;
    Line line;
  };

  ChannelBook& shown() noexcept { return frozen_ ? *frozen_ : book_; }
  const ChannelBook& shown() const noexcept { return frozen_ ? *frozen_ : book_; }
  void follow(const std::string& channel);
  void type(const KeyPress& press);
  bool command(char letter);
  void pause_or_go_on();
  void enter();
  void back();
  bool passes(const std::string& text) const;
  std::vector<Row> channel_rows(std::int64_t now_us) const;
  std::vector<Row> field_rows();
  void put_list(std::vector<Line>& out, const std::string& heading, std::vector<Row> rows, Cursor& cursor,
                std::size_t height);
  void put_plot(std::vector<Line>& out, std::size_t width, std::size_t height);
  std::string title(std::int64_t now_us) const;
  std::string footer() const;

  ChannelBook& book_;
  std::vector<fields::ListNames> names_;
  std::string source_;
  fields::MessageView message_;
  Page page_ = Page::kChannels;
  Cursor channel_cursor_, field_cursor_;
  std::string channel_;              ///< looked at
  std::string field_;                ///< path of the field that is plotted
  std::vector<std::string> listed_;  ///< keys of the rows shown last, for Enter
  std::size_t rows_ = 1;             ///< on a page, of the last rendering
  std::string filter_;
  bool typing_filter_ = false;
  std::optional<ChannelBook> frozen_;  ///< while the user pauses
  std::int64_t frozen_us_ = 0;
  std::int64_t now_us_ = 0;  ///< of the last rendering
};

}  // namespace sprung::spy
