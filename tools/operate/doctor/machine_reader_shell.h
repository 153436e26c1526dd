#pragma once
/// Reads what the kernel says of a machine. Everything below `root`, "/" in earnest: tests give a tree of
/// their own.
#include <string>

#include "tools/operate/doctor/machine_facts.h"
#include "tools/operate/doctor/real_time_checks.h"

namespace sprung::doctor {

KernelFacts read_kernel(const std::string& root);
LimitFacts read_limits();
UtcFacts read_utc();
/// Of the file system that a folder is, or will be, on.
DiskFacts read_disk(const std::string& folder);

/// "0-2,5" as the kernel writes sets of CPUs.
std::vector<int> parse_cpus(const std::string& text);
/// Device that /proc/net/route gives to an address; the longest prefix wins. @param address in network order,
/// as hexadecimal there.
std::string route_device(const std::string& table, std::uint32_t address);

}  // namespace sprung::doctor
