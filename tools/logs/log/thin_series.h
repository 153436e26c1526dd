#pragma once
/// A curve of any length in bounded memory, for pictures: stretches of equally many samples, each with its
/// lowest and its highest. Pure.
#include <cstddef>
#include <vector>

namespace sprung::log {

class ThinSeries {
 public:
  static constexpr std::size_t kMostStretches = 8192;  // a picture is 1000 to 4000 pixels wide

  void add(double x, double y);
  /// In the order in which they were added; a NaN of y is a gap. Up to kMostStretches samples come back as
  /// they were.
  std::vector<double> x() const;
  std::vector<double> y() const;
  bool empty() const noexcept { return stretches_.empty(); }

 private:
  struct Sample {
    double x = 0.0;
    double y = 0.0;
  };
  struct Stretch {
    Sample first_extreme, second_extreme;  ///< lowest and highest, the earlier one first
    bool finite = false;                   ///< any sample was
    bool gap = false;                      ///< any sample was not
    double gap_x = 0.0;
  };
  static void join(Stretch& stretch, const Stretch& next) noexcept;
  void halve();
  template <class Take>
  std::vector<double> collect(Take&& take) const;

  std::vector<Stretch> stretches_;
  std::size_t samples_each_ = 1;
  std::size_t in_last_ = 0;  ///< samples of the last stretch
};

}  // namespace sprung::log
