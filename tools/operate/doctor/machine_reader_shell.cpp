#include "tools/operate/doctor/machine_reader_shell.h"

#include <arpa/inet.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/timex.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace sprung::doctor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLcmGroup = "239.255.76.67";

std::string read_text(const fs::path& path) {
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::map<std::string, std::string> read_governors(const fs::path& cpus) {
  std::map<std::string, std::string> governors;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(cpus, none)) {
    const std::string governor = read_text(entry.path() / "cpufreq/scaling_governor");
    if (!governor.empty()) governors[entry.path().filename().string()] = governor;
  }
  return governors;
}

bool gets_fifo() {
  bool granted = false;
  std::thread([&granted] {
    sched_param parameters{};
    parameters.sched_priority = 1;
    granted = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  }).join();
  return granted;
}

}  // namespace

std::vector<int> parse_cpus(const std::string& text) {
  std::vector<int> cpus;
  std::istringstream ranges(text);
  for (std::string range; std::getline(ranges, range, ',');) {
    if (range.empty()) continue;
    const std::size_t dash = range.find('-');
    const int first = std::atoi(range.c_str());
    const int last = dash == std::string::npos ? first : std::atoi(range.c_str() + dash + 1);
    for (int cpu = first; cpu <= last; ++cpu) cpus.push_back(cpu);
  }
  return cpus;
}

std::string route_device(const std::string& table, std::uint32_t address) {
  std::istringstream lines(table);
  std::string line, best;
  std::uint32_t best_mask = 0;
  std::getline(lines, line);  // titles
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string device, gateway, skipped;
    std::uint32_t destination = 0, flags = 0, mask = 0;
    fields >> device >> std::hex >> destination >> gateway >> flags >> skipped >> skipped >> skipped >> mask;
    const bool up = (flags & 1U) != 0U;
    const bool longer = best.empty() || ntohl(mask) > ntohl(best_mask);
    if (!fields || !up || (address & mask) != destination || !longer) continue;
    best = device;
    best_mask = mask;
  }
  return best;
}

KernelFacts read_kernel(const std::string& root) {
  const fs::path proc = fs::path(root) / "proc";
  const fs::path sys = fs::path(root) / "sys";
  const fs::path cpus = sys / "devices/system/cpu";
  const fs::path clock = sys / "devices/system/clocksource/clocksource0";
  KernelFacts facts;
  facts.receive_buffer_bytes = std::atoll(read_text(proc / "sys/net/core/rmem_max").c_str());
  facts.governors = read_governors(cpus);
  facts.isolated_cpus = parse_cpus(read_text(cpus / "isolated"));
  facts.cpus = parse_cpus(read_text(cpus / "online"));
  facts.real_time = read_text(sys / "kernel/realtime") == "1";
  facts.clock_source = read_text(clock / "current_clocksource");
  std::istringstream sources(read_text(clock / "available_clocksource"));
  facts.clock_sources.assign(std::istream_iterator<std::string>(sources), {});
  facts.multicast_device = route_device(read_text(proc / "net/route"), inet_addr(kLcmGroup));
  return facts;
}

LimitFacts read_limits() {
  const auto limit = [](auto which) {
    rlimit found{};
    getrlimit(which, &found);
    return found.rlim_cur == RLIM_INFINITY ? std::int64_t{-1} : static_cast<std::int64_t>(found.rlim_cur);
  };
  return {limit(RLIMIT_RTPRIO), limit(RLIMIT_MEMLOCK), geteuid() == 0, gets_fifo()};
}

UtcFacts read_utc() {
  timex state{};
  const int result = adjtimex(&state);
  return {result >= 0 && result != TIME_ERROR && (state.status & STA_UNSYNC) == 0,
          static_cast<double>(state.maxerror) * 1e-3};
}

DiskFacts read_disk(const std::string& folder) {
  std::error_code none;
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there, none) && there.has_relative_path()) there = there.parent_path();
  return {fs::absolute(folder).string(), static_cast<double>(fs::space(there, none).available) * 1e-6};
}

}  // namespace sprung::doctor
