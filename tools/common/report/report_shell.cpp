#include "tools/common/report/report_shell.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace sprung::report {

void write_text(const std::string& text, const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code folder_error;
  if (!folder.empty()) std::filesystem::create_directories(folder, folder_error);
  if (folder_error) {
    throw std::runtime_error("cannot make the folder of " + path + ": " + folder_error.message());
  }
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path + ": " + std::strerror(errno));
}

void write_report(const Report& report, const std::string& path) { write_text(to_html(report), path); }

}  // namespace sprung::report
