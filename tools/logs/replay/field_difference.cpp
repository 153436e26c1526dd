#include "tools/logs/replay/field_difference.h"

#include <limits>
#include <utility>

#include "tools/logs/fields/value_text.h"

namespace sprung {

namespace {

/// As few digits as tell the values apart; with the last, any two differ.
constexpr int kDigits[] = {6, 9, 12, 15, 17};

FieldDifference whole(const std::string& first, const std::string& second) {
  return {"", "", first, second, std::numeric_limits<double>::quiet_NaN()};
}

/// Each run's key is another, and a replay has none.
bool is_mac(const fields::Field& field) { return field.path == "mac"; }

std::string described(fields::Fault fault, const fields::MessageView& message, const Bytes& bytes) {
  if (bytes.empty()) return "no message";
  if (fault != fields::Fault::kNone) return std::string("not readable: ") + name(fault);
  return message.layout()->type->name + ", " + std::to_string(bytes.size()) + " bytes";
}

}  // namespace

std::vector<FieldDifference> MessageComparison::compare(const Bytes& first, const Bytes& second) {
  const fields::Fault first_fault = decoder_.open(first.data(), first.size(), first_);
  const fields::Fault second_fault = decoder_.open(second.data(), second.size(), second_);
  const bool readable = first_fault == fields::Fault::kNone && second_fault == fields::Fault::kNone;
  if (!readable || first_.layout() != second_.layout()) {
    if (first == second) return {};
    return {whole(described(first_fault, first_, first), described(second_fault, second_, second))};
  }
  std::vector<FieldDifference> out;
  for (std::size_t i = 0; i < first_.fields().size(); ++i) {
    const fields::Field& field = first_.fields()[i];
    const bool is_session = static_cast<int>(i) == first_.layout()->session;
    if (is_session || is_mac(field) || first_.bytes(field) == second_.bytes(field)) continue;
    FieldDifference difference{field.path, field.unit, "", "", second_.number(field) - first_.number(field)};
    for (const int digits : kDigits) {
      difference.first = fields::value_text(first_, field, digits);
      difference.second = fields::value_text(second_, field, digits);
      if (difference.first != difference.second) break;
    }
    out.push_back(std::move(difference));
  }
  return out;
}

}  // namespace sprung
