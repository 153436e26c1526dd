#pragma once
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace sprung::report {

/// An empty folder that is removed at the end.
struct ReportFolder {
  std::filesystem::path path;

  ReportFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sprung-report-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~ReportFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;
};

inline std::string file_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace sprung::report
