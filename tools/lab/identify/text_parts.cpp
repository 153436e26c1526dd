#include "tools/lab/identify/text_parts.h"

#include <optional>
#include <stdexcept>

namespace sprung::identify {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> out;
  std::size_t from = 0;
  for (std::size_t at = text.find(separator); at != std::string::npos; at = text.find(separator, from)) {
    out.push_back(text.substr(from, at - from));
    from = at + 1;
  }
  out.push_back(text.substr(from));
  return out;
}

namespace {

identification::TimeSpan parse_span(const std::string& text, const std::string& all, const char* option) {
  const std::size_t colon = text.find(':');
  const std::optional<double> from = parse_number(text.substr(0, colon));
  const std::optional<double> to = colon == std::string::npos ? std::nullopt
                                                              : parse_number(text.substr(colon + 1));
  if (!from || !to || !(*from < *to))
    throw std::invalid_argument(std::string(option) + " " + all +
                                ": expected FROM:TO, rising, for example 0:0.5 or 0:0.25,0.5:0.75");
  return {*from, *to};
}

}  // namespace

std::vector<identification::TimeSpan> parse_spans(const std::string& text, const char* option) {
  std::vector<identification::TimeSpan> out;
  for (const std::string& part : split(text, ',')) out.push_back(parse_span(part, text, option));
  return out;
}

}  // namespace sprung::identify
