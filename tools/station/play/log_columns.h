#pragma once
/// A log's frames as columns for a page, of bounded size however long the log is. Pure.
///
/// Two views of the same frames. `moments` are frames as they were, all of them or every nth: what the robot
/// in 3-D is drawn from. `stretches` are n cycles each with the lowest and highest value of each field: what
/// plots are drawn from, so that no peak is lost.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/station/frames/frames.h"

namespace sprung::station {

struct ColumnLimits {
  std::size_t moments = 36'000;            ///< at most: 60 a second of ten minutes
  std::size_t stretch_values = 3'000'000;  ///< at most, all fields together
};

class LogColumns {
 public:
  /// @param cycles that will come at most; more are left out.
  LogColumns(const std::vector<FrameField>& fields, std::size_t cycles, const ColumnLimits& limits = {});

  void add(const Frame& frame);

  std::size_t cycles() const noexcept { return cycles_; }
  std::size_t cycles_a_moment() const noexcept { return cycles_a_moment_; }
  std::size_t cycles_a_stretch() const noexcept { return cycles_a_stretch_; }

  /// ```
  /// {"cycles": 4000, "cycles_a_moment": 1, "moments": 4000, "moment_fields": [0, 5, ...],
  ///  "cycles_a_stretch": 1, "stretches": 4000, "stretch_fields": [...], "bytes": of packed() unpacked}
  /// ```
  /// Fields are indices into the layout's; one that was never measured is left out.
  nlohmann::json description() const;
  /// gzip, base64. Inside, little endian, of each column all first bytes, then all second ones, and so on:
  /// moments' times (float64), a float32 column for each of moment_fields; stretches' begins (float64), then
  /// for each of stretch_fields its lowest and, where cycles_a_stretch is above 1, its highest.
  /// @throws std::runtime_error where zlib fails.
  std::string packed() const;

 private:
  struct Column {
    int field = 0;
    std::vector<float> low, high;  ///< high: of stretches of several cycles alone
    bool any = false;              ///< a finite value came
  };
  void add_moment(const Frame& frame);
  void add_to_stretch(const Frame& frame);

  std::size_t cycles_ = 0;
  std::size_t cycles_a_moment_ = 1;
  std::size_t cycles_a_stretch_ = 1;
  std::vector<double> moment_time_s_, stretch_time_s_;
  std::vector<Column> moments_, stretches_;
};

}  // namespace sprung::station
