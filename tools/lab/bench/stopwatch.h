#pragma once
/// Medians of repeated measurements, each beside a reference loop.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <vector>

namespace sprung {

/// Time of one call of `work`, ns.
template <class Work>
double time_ns(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/// Of this thread.
inline double processor_s() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// @param values not empty; the lower of the two in the middle of an even number.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Keeps a result, so that the loop which made it is not optimised away.
inline void keep(std::uint64_t value) { asm volatile("" : : "r"(value) : "memory"); }

/// Reference: a chain of 64 multiplications and exclusive ors (FNV-1a), each of which waits for the one
/// before; nothing that a compiler, cache or vector unit makes faster. @return ns a chain.
inline double reference_ns() {
  constexpr int kChains = 2000;
  std::uint64_t hash = 14695981039346656037ULL;
  const double ns = time_ns([&hash] {
    for (std::uint64_t i = 0; i < std::uint64_t{kChains} * 64; ++i)
      hash = (hash ^ (i & 0xFF)) * 1099511628211ULL;
  });
  keep(hash);
  return ns / kChains;
}

struct Measured {
  double ns = 0.0;     ///< median
  double ratio = 0.0;  ///< median of each run's ratio to the reference beside it
};

/// @param work returns ns of one unit of what is measured. @param runs >= 1.
template <class Work>
Measured measure(int runs, Work&& work) {
  std::vector<double> times, ratios;
  for (int run = 0; run < runs; ++run) {
    const double reference = reference_ns();
    times.push_back(work());
    ratios.push_back(times.back() / reference);
  }
  return {median(times), median(ratios)};
}

}  // namespace sprung
