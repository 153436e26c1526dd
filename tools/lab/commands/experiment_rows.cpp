#include "tools/lab/commands/experiment_rows.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "runtime/command_line.h"

namespace sprung::commands {

void write_rows(const ExperimentReport& rows, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = std::filesystem::path(folder) / (rows.experiment + ".json");
  std::ofstream out(path);
  out << rows.json() << "\n";
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

int print_rows(const ExperimentReport& rows, bool as_json) {
  std::printf("%s\n", (as_json ? rows.json() : rows.table()).c_str());
  return rows.ok() ? kExitDone : kExitFailed;
}

}  // namespace sprung::commands
