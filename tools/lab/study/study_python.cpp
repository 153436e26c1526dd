#include "tools/lab/study/study_python.h"

#include <cstdlib>
#include <filesystem>

#include "tools/lab/study/piped_child_shell.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

std::string module_folder() {
  std::error_code none;
  for (const fs::path& folder :
       {fs::path(SPRUNG_PYTHON_DIR), fs::path(program_folder()) / "../share/sprung/python"}) {
    if (fs::is_directory(folder / "sprung_study", none)) return folder.string();
  }
  return "";
}

std::string interpreter() {
  const char* asked = std::getenv("SPRUNG_PYTHON");
  return asked != nullptr && *asked != '\0' ? asked : system_program("python3", "python3");
}

}  // namespace

std::string run_study_python(const std::vector<std::string>& words) {
  const std::string folder = module_folder();
  if (folder.empty()) return "python/sprung_study is neither beside the sources nor installed";
  try {
    std::vector<std::string> all = {"/usr/bin/env", "PYTHONPATH=" + folder, interpreter(), "-m",
                                    "sprung_study"};
    all.insert(all.end(), words.begin(), words.end());
    PipedChild child(all);
    while (child.read_more()) {
    }
    std::string said, last;
    while (const auto line = child.line()) last = *line;
    const std::string ended = child.wait();
    return last == "done" ? "" : last.empty() ? interpreter() + ": " + ended : last;
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace sprung
