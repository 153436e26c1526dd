#include "runtime/resource_use.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "runtime/session_clock.h"

namespace sprung {
namespace {

std::int64_t cpu_time_us() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto us = [](const timeval& time) { return std::int64_t{time.tv_sec} * 1'000'000 + time.tv_usec; };
  return us(usage.ru_utime) + us(usage.ru_stime);
}

}  // namespace

std::int64_t resident_kB() {
  long pages = 0;
  if (FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return std::int64_t{pages} * sysconf(_SC_PAGESIZE) / 1024;
}

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "localhost";
  return name.data();
}

CpuMeter::CpuMeter() : cpu_us_(cpu_time_us()), wall_us_(monotonic_us()) {}

double CpuMeter::cpu_share() {
  const std::int64_t cpu_us = cpu_time_us();
  const std::int64_t wall_us = monotonic_us();
  const double taken = share(cpu_us - cpu_us_, wall_us - wall_us_);
  cpu_us_ = cpu_us;
  wall_us_ = wall_us;
  return taken;
}

double CpuMeter::share(std::int64_t cpu_us, std::int64_t wall_us) noexcept {
  return wall_us > 0 ? static_cast<double>(cpu_us) / static_cast<double>(wall_us) : 0.0;
}

}  // namespace sprung
