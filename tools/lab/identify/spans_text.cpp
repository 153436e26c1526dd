#include "tools/lab/identify/spans_text.h"

#include <optional>
#include <stdexcept>

#include "tools/lab/identify/number_text.h"
#include "tools/lab/identify/text_parts.h"

namespace sprung::identify {

namespace {

identification::TimeSpan parse_span(const std::string& text, const std::string& all, const char* option) {
  const std::size_t colon = text.find(':');
  const std::optional<double> from = parse_number(text.substr(0, colon));
  const std::optional<double> to =
      colon == std::string::npos ? std::nullopt : parse_number(text.substr(colon + 1));
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
