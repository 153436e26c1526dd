#include "tools/logs/fields/units.h"

#include <array>
#include <utility>

namespace sprung::fields {

namespace {

using Entry = std::pair<std::string_view, std::string_view>;

/// What a name ends with, longest first.
constexpr std::array<Entry, 28> kEndings{{
    {"_Nm_s_rad", "Nm s/rad"},
    {"_Nm_rad", "Nm/rad"},
    {"_rad_s2", "rad/s2"},
    {"_m2_s2", "m2/s2"},
    {"_rad_s", "rad/s"},
    {"_N_s_m", "N s/m"},
    {"_m_s2", "m/s2"},
    {"_rad2", "rad2"},
    {"_share", "1"},
    {"_utime", "us"},
    {"_degC", "degC"},
    {"_N_m", "N/m"},
    {"_m_s", "m/s"},
    {"_rad", "rad"},
    {"_deg", "deg"},
    {"_m2", "m2"},
    {"_us", "us"},
    {"_ms", "ms"},
    {"_mm", "mm"},
    {"_Nm", "Nm"},
    {"_Hz", "Hz"},
    {"_kg", "kg"},
    {"_kB", "kB"},
    {"_N", "N"},
    {"_A", "A"},
    {"_V", "V"},
    {"_m", "m"},
    {"_s", "s"},
}};

bool ends_with(std::string_view text, std::string_view ending) {
  return text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending;
}

}  // namespace

std::string unit_of(std::string_view member, std::size_t index) {
  if (member == "utime") return "us";
  if (member == "wrench") return index < 3 ? "N" : "Nm";
  if (member == "desired_speed" || member == "walk_speed") return index < 2 ? "m/s" : "rad/s";
  for (const auto& [ending, unit] : kEndings) {
    if (ends_with(member, ending)) return std::string(unit);
  }
  return "";
}

}  // namespace sprung::fields
