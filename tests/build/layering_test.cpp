/// Cores take values and a time and return values and a status. With LCM in /usr/include a wrong include
/// still compiles, so the walls between cores and shells are checked here, by reading the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kRooms = {"signals",   "model",      "robots",  "runtime",    "drivers",
                                         "estimator", "controller", "planner", "simulation", "tools"};

/// Folders whose files are cores, and the files in them that are shells.
const std::vector<std::string> kCoreFolders = {"signals",
                                               "model",
                                               "estimator",
                                               "controller",
                                               "planner",
                                               "drivers/canopen",
                                               "drivers/cia402",
                                               "drivers/profiles",
                                               "drivers/bridge",
                                               "simulation",
                                               "tools/can/decode",
                                               "tools/common/report",
                                               "tools/operate/doctor",
                                               "tools/logs/fields",
                                               "tools/logs/spy",
                                               "tools/station/frames",
                                               "tools/station/gateway",
                                               "tools/station/page",
                                               "tools/station/server"};
const std::regex kShell(R"((_main|_shell|_lockstep|_realtime)\.(h|cpp)$)");
const std::regex kMessages(R"(signals/messages|signals/message_fields)");

/// What would bring a clock, a socket, a log, a thread or LCM into a core. An address is but a text taken
/// apart, a message's layout but numbers.
const std::regex kForbidden(
    R"(#include\s+[<"](lcm/|spdlog/|CLI/|runtime/(?!transport/lcm_address|message_layout)|chrono|thread|mutex|condition_variable|sys/socket|sys/time|time\.h|ctime|poll\.h|unistd\.h|iostream|fstream|random|drivers/can/(can_bus|udp_bus|socketcan_bus|lockstep_link)))");
const std::regex kMessageHeader(R"(#include\s+[<"]sprung_msgs/)");
/// The plant's and the robot's files are read once, when a core is built.
const std::regex kReadsFiles(R"((sim_config|plant_model|model_places|plant)\.(h|cpp)$)");
/// A profile's folder holds both sides of the cable; the simulated one is told by its name.
const std::regex kSimulatedDevice(R"(drivers/profiles/[^/]+/\w+_device\w*\.(h|cpp)$)");

const std::regex kOwnInclude(R"(^#include\s+"([^"]+)\")");

bool is_source(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

std::vector<fs::path> cores() {
  std::vector<fs::path> found;
  for (const std::string& folder : kCoreFolders) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_dir()) / folder)) {
      if (is_source(entry.path()) && !std::regex_search(entry.path().string(), kShell))
        found.push_back(entry.path());
    }
  }
  return found;
}

/// Lines of a file that hold `part`, and match: looking for the part first is twenty times as quick.
std::string lines_with(const fs::path& path, const std::regex& pattern, const char* part = "") {
  std::ifstream in(path);
  std::string line, found;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find(part) != std::string::npos && std::regex_search(line, pattern))
      found += path.string() + ":" + std::to_string(number) + ": " + line + "\n";
  }
  return found;
}

TEST(Layering, ThereAreCoresToCheck) { EXPECT_GT(cores().size(), 100u); }

TEST(Layering, NoCoreReachesTransportClockLogOrThreads) {
  std::string found;
  for (const fs::path& path : cores()) {
    if (!std::regex_search(path.string(), kReadsFiles)) found += lines_with(path, kForbidden, "#include");
  }
  EXPECT_EQ(found, "");
}

TEST(Layering, OnlyTheConversionsKnowMessages) {
  std::string found;
  for (const fs::path& path : cores()) {
    if (!std::regex_search(path.string(), kMessages)) found += lines_with(path, kMessageHeader, "#include");
  }
  EXPECT_EQ(found, "");
}

TEST(Layering, OnlySimulationReadsThePlant) {
  const std::regex plant(R"(sim\.yaml|model\.xml|simulation/)");
  std::string found;
  for (const char* folder : {"model", "estimator", "controller", "planner", "drivers/bridge",
                             "drivers/profiles", "runtime", "robots"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_dir()) / folder)) {
      const bool device = std::regex_search(entry.path().string(), kSimulatedDevice);
      if (is_source(entry.path()) && !device) found += lines_with(entry.path(), plant);
    }
  }
  found = std::regex_replace(found, std::regex(R"([^\n]*: *//[^\n]*\n)"), "");  // comments may name it
  EXPECT_EQ(found, "");
}

/// From the bottom up; what stands in one row are neighbours, and none includes another. A tool's commands
/// are the roof: they may use whatever they command, and are used by none but the roof.
const std::vector<std::vector<std::string>> kFloors = {{"lcmtypes"},
                                                       {"signals"},
                                                       {"model"},
                                                       {"robots"},
                                                       {"runtime"},
                                                       {"drivers", "estimator", "controller"},
                                                       {"planner"},
                                                       {"simulation"},
                                                       {"tools/common"},
                                                       {"tools/operate"},
                                                       {"tools/can"},
                                                       {"tools/logs"},
                                                       {"tools/lab", "tools/station"}};

bool is_roof(const std::string& path) {
  static const std::regex roof(R"(^tools/(\w+/commands/|\w+\.(h|cpp)$))");
  return std::regex_search(path, roof);
}

/// @return the row of kFloors, the one above them for the roof; -1: in none. A simulated device belongs to
/// the simulation, wherever it lies.
int floor_of(const std::string& path) {
  if (is_roof(path)) return static_cast<int>(kFloors.size());
  const std::string placed = std::regex_search(path, kSimulatedDevice) ? "simulation/" : path;
  for (std::size_t floor = 0; floor < kFloors.size(); ++floor) {
    for (const std::string& room : kFloors[floor]) {
      if (placed.rfind(room + "/", 0) == 0) return static_cast<int>(floor);
    }
  }
  return -1;
}

/// drivers, tools/lab, ...: two files of one room may include each other.
std::string room_of(const std::string& path) {
  if (is_roof(path)) return "roof";
  if (std::regex_search(path, kSimulatedDevice)) return "simulation";
  const std::size_t end = path.find('/', path.rfind("tools/", 0) == 0 ? 6 : 0);
  return path.substr(0, end);
}

bool may_include(const std::string& from, const std::string& to) {
  if (floor_of(to) < 0) return false;  // a test's header, say
  return room_of(from) == room_of(to) || floor_of(to) < floor_of(from);
}

TEST(Layering, NoRoomIncludesANeighbourOrUpward) {
  EXPECT_TRUE(may_include("planner/a.h", "controller/b.h"));
  EXPECT_FALSE(may_include("estimator/a.h", "controller/b.h"));
  EXPECT_FALSE(may_include("drivers/can/a.h", "drivers/profiles/gold/gold_device.h"));
  EXPECT_FALSE(may_include("tools/logs/log/a.h", "tools/lab/run/b.h"));
  EXPECT_FALSE(may_include("tools/lab/run/a.h", "tools/lab/commands/b.h"));
  EXPECT_FALSE(may_include("planner/a.h", "tests/support/b.h"));
  const fs::path top = test::source_dir();
  for (const std::string& room : kRooms) {
    for (const auto& entry : fs::recursive_directory_iterator(top / room)) {
      if (!is_source(entry.path())) continue;
      const std::string from = fs::relative(entry.path(), top).string();
      ASSERT_GE(floor_of(from), 0) << from << " is on no floor";
      std::ifstream in(entry.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);) {
        if (!std::regex_search(line, match, kOwnInclude) || !fs::exists(top / match[1].str())) continue;
        EXPECT_TRUE(may_include(from, match[1])) << from << " includes " << match[1];
      }
    }
  }
}

/// Folders of the product's files of this name, x.h, x.cpp or x_shell.cpp.
std::map<std::string, std::set<fs::path>> folders_of_sources() {
  const fs::path top = test::source_dir();
  std::map<std::string, std::set<fs::path>> folders;
  for (const std::string& room : kRooms) {
    for (const auto& entry : fs::recursive_directory_iterator(top / room)) {
      if (!is_source(entry.path())) continue;
      const std::string stem = entry.path().stem().string();
      folders[std::regex_replace(stem, std::regex("_shell$"), "")].insert(
          fs::relative(entry.path().parent_path(), top));
    }
  }
  return folders;
}

/// A test is found by its source's path: x_test.cpp lies where x does, unless two folders have an x.
TEST(Layering, TestOfOneSourceLiesAsItDoes) {
  const fs::path top = test::source_dir();
  const auto folders = folders_of_sources();
  int found = 0;
  for (const std::string& room : kRooms) {
    if (!fs::exists(top / "tests" / room)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(top / "tests" / room)) {
      std::smatch match;
      const std::string name = entry.path().filename().string();
      if (!std::regex_match(name, match, std::regex(R"((\w+)_test\.cpp)"))) continue;
      const auto source = folders.find(match[1]);
      if (source == folders.end()) continue;
      ++found;
      const fs::path tested = fs::relative(entry.path().parent_path(), top / "tests");
      EXPECT_EQ(source->second.count(tested), 1U)
          << name << " is in tests/" << tested << ", its source is in " << *source->second.begin();
    }
  }
  EXPECT_GT(found, 200);
}

TEST(Layering, TestsLieAsTheirSourcesDo) {
  const fs::path top = test::source_dir();
  for (const std::string& room : kRooms) {
    for (const auto& entry : fs::recursive_directory_iterator(top / "tests" / room)) {
      if (!entry.is_directory()) continue;
      const fs::path source = top / fs::relative(entry.path(), top / "tests");
      EXPECT_TRUE(fs::is_directory(source)) << entry.path() << " holds tests of a folder that is not there";
    }
  }
}

TEST(Layering, HeavyHeadersStayInOneFile) {
  const std::vector<std::pair<std::string, std::string>> owners = {
      {R"(#include\s+<CLI/)", "runtime/command_line.cpp"},
      {R"(#include\s+<spdlog/)", "runtime/log.cpp"},
      {R"(#include\s+<yaml-cpp/)", "robots/yaml_tree.cpp"},
      {R"(#include\s+<msgpack)", "drivers/can/udp_datagram.cpp"},
      {R"(#include\s+<ini\.h)", "drivers/canopen/ini_text.cpp"},
      {R"(#include\s+<regex>)", "signals/text_pattern.cpp"},
      {R"(#include\s+<curses\.h)", "tools/logs/spy/spy_shell.cpp"},
      {R"(#include\s+<libwebsockets)", "tools/station/server/web_server_shell.cpp"}};
  for (const auto& [pattern, owner] : owners) {
    for (const std::string& folder : kRooms) {
      for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_dir()) / folder)) {
        const bool owns = entry.path() == fs::path(test::source_dir()) / owner;
        if (is_source(entry.path()) && !owns) {
          EXPECT_EQ(lines_with(entry.path(), std::regex(pattern), "#include"), "");
        }
      }
    }
  }
}

/// What whoever includes a file reads besides, each of which costs from half a second to some:
/// tests/build/cost has the figures.
const std::regex kHeavy(
    R"(#include\s+<(regex|nlohmann/json\.hpp|CLI/|spdlog/|yaml-cpp/|msgpack|lcm/|gtest/|iostream|random|future|Eigen/(Dense|Eigen|QR|SVD|LU|Eigenvalues|Sparse)))");

/// Headers that a header reaches, itself among them.
std::set<fs::path> reached_from(const fs::path& header) {
  std::set<fs::path> reached;
  std::vector<fs::path> open{header};
  while (!open.empty()) {
    const fs::path path = open.back();
    open.pop_back();
    if (!fs::exists(path) || !reached.insert(path).second) continue;
    std::ifstream in(path);
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (std::regex_search(line, match, kOwnInclude))
        open.push_back(fs::path(test::source_dir()) / match[1].str());
    }
  }
  return reached;
}

TEST(Layering, NoHeaderOfACoreReachesAHeavyOne) {
  std::string found;
  for (const fs::path& path : cores()) {
    if (path.extension() != ".h") continue;
    for (const fs::path& reached : reached_from(path)) {
      const std::string lines = lines_with(reached, kHeavy, "#include");
      if (!lines.empty()) found += path.string() + " reaches " + lines;
    }
  }
  EXPECT_EQ(found, "");
}

TEST(Layering, HeadersDeclareJsonAndNeverMakeIt) {
  std::string found;
  for (const std::string& folder : kRooms) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_dir()) / folder)) {
      if (entry.path().extension() == ".h")
        found += lines_with(entry.path(), std::regex(R"(#include\s+<nlohmann/json\.hpp>)"), "#include");
    }
  }
  EXPECT_EQ(found, "") << "include <nlohmann/json_fwd.hpp>";
}

}  // namespace
}  // namespace sprung
