#include "tools/station/play/log_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/station/play/packing.h"

namespace sprung::station {

namespace {

/// Bits of a float's mantissa that are kept: what is far below any sensor's noise costs most of the bytes.
constexpr int kMomentBits = 17;
constexpr int kStretchBits = 13;

bool starts_with(const std::string& text, const char* begin) { return text.rfind(begin, 0) == 0; }
bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// What the robot in 3-D and the panels beside it show of one moment.
bool is_drawn(const FrameField& field) {
  static const std::vector<std::string> kEnds = {".estimated_position_rad", ".desired_position_rad",
                                                 ".gear_output_torque_Nm",  ".contact",
                                                 ".true_ground_height_m",   ".gear_output_torque_bound_Nm"};
  static const std::vector<std::string> kParts = {".foot_force_N.", ".true_contact_force_N."};
  if (starts_with(field.name, "trunk.") || starts_with(field.name, "safety.") || field.name == "motion.state")
    return true;
  if (ends_with(field.name, ".phase")) return true;
  return std::any_of(kEnds.begin(), kEnds.end(),
                     [&](const std::string& end) { return ends_with(field.name, end); }) ||
         std::any_of(kParts.begin(), kParts.end(),
                     [&](const std::string& part) { return field.name.find(part) != std::string::npos; });
}

bool is_plotted(const FrameField& field) {
  return !starts_with(field.name, "truth.") && !starts_with(field.name, "trunk.q");
}

std::size_t share(std::size_t all, std::size_t most) {
  return std::max<std::size_t>(1, (all + most - 1) / most);
}

}  // namespace

LogColumns::LogColumns(const std::vector<FrameField>& fields, std::size_t cycles,
                       const ColumnLimits& limits) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (is_drawn(fields[i])) moments_.push_back({static_cast<int>(i), {}, {}});
    if (is_plotted(fields[i])) stretches_.push_back({static_cast<int>(i), {}, {}});
  }
  cycles_a_moment_ = share(cycles, limits.moments);
  const std::size_t columns = std::max<std::size_t>(1, stretches_.size());
  cycles_a_stretch_ = share(cycles, limits.stretch_values / columns);
  if (cycles_a_stretch_ > 1) cycles_a_stretch_ = share(cycles, limits.stretch_values / (2 * columns));
}

void LogColumns::add(const Frame& frame) {
  if (cycles_ % cycles_a_moment_ == 0) add_moment(frame);
  add_to_stretch(frame);
  ++cycles_;
}

void LogColumns::add_moment(const Frame& frame) {
  moment_time_s_.push_back(frame.time_s);
  for (Column& column : moments_) {
    const float value = frame.values[static_cast<std::size_t>(column.field)];
    column.any = column.any || std::isfinite(value);
    column.low.push_back(value);
  }
}

void LogColumns::add_to_stretch(const Frame& frame) {
  const bool begins = cycles_ % cycles_a_stretch_ == 0;
  if (begins) stretch_time_s_.push_back(frame.time_s);
  for (Column& column : stretches_) {
    const float value = frame.values[static_cast<std::size_t>(column.field)];
    column.any = column.any || std::isfinite(value);
    if (begins) {
      column.low.push_back(value);
      if (cycles_a_stretch_ > 1) column.high.push_back(value);
    } else {  // fmin and fmax take the other one of a NaN
      column.low.back() = std::fmin(column.low.back(), value);
      column.high.back() = std::fmax(column.high.back(), value);
    }
  }
}

nlohmann::json LogColumns::description() const {
  const auto fields_of = [](const std::vector<Column>& columns) {
    nlohmann::json fields = nlohmann::json::array();
    for (const Column& column : columns)
      if (column.any) fields.push_back(column.field);
    return fields;
  };
  return {{"cycles", cycles_},
          {"cycles_a_moment", cycles_a_moment_},
          {"moments", moment_time_s_.size()},
          {"moment_fields", fields_of(moments_)},
          {"cycles_a_stretch", cycles_a_stretch_},
          {"stretches", stretch_time_s_.size()},
          {"stretch_fields", fields_of(stretches_)}};
}

std::string LogColumns::packed() const {
  Packer packer;
  packer.add(moment_time_s_);
  for (const Column& column : moments_)
    if (column.any) packer.add(column.low, kMomentBits);
  packer.add(stretch_time_s_);
  for (const Column& column : stretches_) {
    if (!column.any) continue;
    packer.add(column.low, kStretchBits);
    if (cycles_a_stretch_ > 1) packer.add(column.high, kStretchBits);
  }
  return packer.base64();
}

}  // namespace sprung::station
