#pragma once
/// The last seconds of every number of one channel, for small plots. Pure.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tools/logs/fields/decoder.h"

namespace sprung::spy {

class FieldHistory {
 public:
  static constexpr std::int64_t kInterval_us = 20'000;  ///< between samples, of what may come more often
  static constexpr std::size_t kSamples = 500;          ///< so the last 10 s

  /// Takes a sample if it is time. Begins anew when the message's layout is another one.
  void add(std::int64_t arrival_us, const fields::MessageView& message);
  void clear();
  /// Samples of the field of that index in the layout, oldest first; NaN of fields that are no numbers.
  std::vector<double> of(std::size_t field) const;

 private:
  std::shared_ptr<const fields::Layout> layout_;
  std::vector<double> samples_;  ///< ring of rows, one a message
  std::size_t rows_ = 0;         ///< in the ring
  std::size_t next_ = 0;
  std::int64_t last_us_ = 0;
};

}  // namespace sprung::spy
