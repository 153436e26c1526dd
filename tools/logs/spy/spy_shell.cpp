#include "tools/logs/spy/spy_shell.h"

#include <langinfo.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstring>
#include <stdexcept>

// Last: its macros (timeout, erase, ...) are many.
#include <curses.h>

namespace sprung::spy {

struct SpyTerminal::Screen {
  SCREEN* handle = nullptr;
};

namespace {

constexpr int kEscape = 27;
constexpr int kDelete = 127;
constexpr int kEscapeDelay_ms = 25;  // ncurses' own second would make Esc feel dead

enum Color : short { kTitleColor = 1, kWarningColor = 2, kFaintColor = 3 };

int attributes_of(Style style) {
  switch (style) {
    case Style::kTitle:
      return static_cast<int>(A_BOLD | static_cast<chtype>(COLOR_PAIR(kTitleColor)));
    case Style::kSelected:
      return static_cast<int>(A_REVERSE);
    case Style::kWarning:
      return COLOR_PAIR(kWarningColor);
    case Style::kFaint:
      return COLOR_PAIR(kFaintColor);
    case Style::kPlain:
      return 0;
  }
  return 0;
}

void prepare_colors() {
  if (!has_colors()) return;
  start_color();
  use_default_colors();
  init_pair(kTitleColor, COLOR_CYAN, -1);
  init_pair(kWarningColor, COLOR_YELLOW, -1);
  init_pair(kFaintColor, COLOR_GREEN, -1);
}

/// Plots are in letters beyond ASCII.
void prepare_letters() {
  std::setlocale(LC_ALL, "");
  if (std::strcmp(nl_langinfo(CODESET), "UTF-8") != 0) std::setlocale(LC_CTYPE, "C.UTF-8");
  std::setlocale(LC_NUMERIC, "C");
}

Key key_of(int code) {
  switch (code) {
    case KEY_UP:
      return Key::kUp;
    case KEY_DOWN:
      return Key::kDown;
    case KEY_PPAGE:
      return Key::kPageUp;
    case KEY_NPAGE:
      return Key::kPageDown;
    case KEY_HOME:
      return Key::kHome;
    case KEY_END:
      return Key::kEnd;
    case KEY_ENTER:
    case KEY_RIGHT:
    case '\n':
    case '\r':
      return Key::kEnter;
    case KEY_LEFT:
    case kEscape:
      return Key::kBack;
    case KEY_BACKSPACE:
    case '\b':
    case kDelete:
      return Key::kErase;
    default:
      return code >= ' ' && code < kDelete ? Key::kLetter : Key::kNone;
  }
}

}  // namespace

SpyTerminal::SpyTerminal() : screen_(new Screen) {
  prepare_letters();
  if (isatty(STDOUT_FILENO) != 0 && isatty(STDIN_FILENO) != 0)
    screen_->handle = newterm(nullptr, stdout, stdin);
  if (screen_->handle == nullptr) {
    delete screen_;
    throw std::runtime_error(
        "this is no terminal to draw on: use 'sprung topics' and 'sprung watch', or set TERM");
  }
  set_escdelay(kEscapeDelay_ms);
  cbreak();
  noecho();
  keypad(stdscr, TRUE);
  curs_set(0);
  prepare_colors();
}

SpyTerminal::~SpyTerminal() {
  endwin();
  delscreen(screen_->handle);
  delete screen_;
}

std::size_t SpyTerminal::width() const noexcept { return static_cast<std::size_t>(COLS); }
std::size_t SpyTerminal::height() const noexcept { return static_cast<std::size_t>(LINES); }

void SpyTerminal::show(const std::vector<Line>& lines) {
  werase(stdscr);
  for (std::size_t row = 0; row < lines.size() && row < height(); ++row) {
    const int attributes = attributes_of(lines[row].style);
    wattron(stdscr, attributes);
    mvwaddstr(stdscr, static_cast<int>(row), 0, lines[row].text.c_str());
    wattroff(stdscr, attributes);
  }
  wrefresh(stdscr);
}

KeyPress SpyTerminal::key(int timeout_ms) {
  wtimeout(stdscr, timeout_ms);
  const int code = wgetch(stdscr);
  const Key key = code == ERR ? Key::kNone : key_of(code);
  return {key, key == Key::kLetter ? static_cast<char>(code) : '\0'};
}

}  // namespace sprung::spy
