#pragma once
/// Writes every value of nested configuration structs as lines of text, "joints[3].position_min_rad = 0.1",
/// so that two loaders, or two ways to write one file, can be compared value by value.
///
/// A struct is taken apart by a structured binding: one more field in it does not compile until it is dumped.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace sprung::test {

class ValueDump {
 public:
  const std::string& text() const noexcept { return text_; }

  void line(const std::string& path, const std::string& value) { text_ += path + " = " + value + "\n"; }

  /// @param names one word for each of `values`.
  template <class... Values>
  void fields(const std::string& path, const std::string& names, const Values&... values) {
    std::istringstream in(names);
    const auto one = [&](const auto& value) {
      std::string name;
      if (!(in >> name)) throw std::logic_error(path + ": fewer names than values");
      dump_value(*this, path.empty() ? name : path + "." + name, value);
    };
    (one(values), ...);
    std::string left;
    if (in >> left) throw std::logic_error(path + ": " + left + " has no value");
  }

 private:
  std::string text_;
};

/// 17 digits: what tells any two doubles apart.
inline void dump_value(ValueDump& dump, const std::string& path, double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  dump.line(path, text);
}

inline void dump_value(ValueDump& dump, const std::string& path, const std::string& value) {
  dump.line(path, "'" + value + "'");
}

template <class Whole>
std::enable_if_t<std::is_integral_v<Whole> || std::is_enum_v<Whole>> dump_value(ValueDump& dump,
                                                                                const std::string& path,
                                                                                const Whole& value) {
  dump.line(path, std::to_string(static_cast<long long>(value)));
}

template <class Values>
void dump_each(ValueDump& dump, const std::string& path, const Values& values) {
  std::size_t i = 0;
  for (const auto& value : values) dump_value(dump, path + "[" + std::to_string(i++) + "]", value);
}

template <class Value>
void dump_value(ValueDump& dump, const std::string& path, const std::vector<Value>& values) {
  dump.line(path + ".size", std::to_string(values.size()));
  dump_each(dump, path, values);
}

template <class Value, std::size_t N>
void dump_value(ValueDump& dump, const std::string& path, const std::array<Value, N>& values) {
  dump_each(dump, path, values);
}

template <class Value>
void dump_value(ValueDump& dump, const std::string& path, const std::optional<Value>& value) {
  if (value)
    dump_value(dump, path, *value);
  else
    dump.line(path, "nothing");
}

/// The dump kept beside a test. With $SPRUNG_WRITE_DUMPS set it is written anew from `now` first: look at
/// `git diff` before that is committed.
inline std::string kept_dump(const std::string& path, const std::string& now) {
  if (std::getenv("SPRUNG_WRITE_DUMPS") != nullptr) std::ofstream(path) << now;
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The first lines that differ; "" where none does.
inline std::string first_difference(const std::string& kept, const std::string& now) {
  std::istringstream a(kept), b(now);
  for (std::string before, after;;) {
    const bool more_a = static_cast<bool>(std::getline(a, before));
    const bool more_b = static_cast<bool>(std::getline(b, after));
    if (!more_a && !more_b) return "";
    if (!more_a || !more_b || before != after)
      return "kept: " + (more_a ? before : "nothing more") + "\nnow:  " + (more_b ? after : "nothing more");
  }
}

}  // namespace sprung::test
