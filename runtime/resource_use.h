#pragma once
/// What this process takes of its machine, for PROCESS_STATUS.
#include <cstdint>
#include <string>

namespace sprung {

/// Resident memory of this process, kB; 0 where /proc is not there.
std::int64_t resident_kB();
/// Name of this machine, "localhost" where it has none.
std::string host_name();

/// Share of one core that all threads of this process took between two looks.
class CpuMeter {
 public:
  CpuMeter();
  /// Since the last look (the first: since the constructor); 0 where no time has passed.
  double cpu_share();
  /// Pure part of it: times in us.
  static double share(std::int64_t cpu_us, std::int64_t wall_us) noexcept;

 private:
  std::int64_t cpu_us_;
  std::int64_t wall_us_;
};

}  // namespace sprung
