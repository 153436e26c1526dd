#include "tools/logs/log/picture_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "tools/common/report/report_shell.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung::log {

namespace {

namespace fs = std::filesystem;

constexpr double kTimeout_s = 60.0;

/// A folder of its own for the browser, gone afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "sprung_picture_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a folder in " + fs::temp_directory_path().string() + ": " +
                               std::strerror(errno));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;  // a browser's helper may still be writing
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string operator/(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string browser() {
  try {
    return system_program("chromium", "chromium");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + "; or write .html, which needs none");
  }
}

}  // namespace

namespace {

void shoot(const std::string& path, const std::string& html, const std::string& fragment,
           const std::vector<std::string>& drawing, int width, int height) {
  const std::string program = browser();
  const ScratchFolder folder;
  report::write_text(html, folder / "plot.html");
  const std::string shot = folder / "plot.png";
  std::vector<std::string> arguments{"--headless",
                                     "--no-sandbox",
                                     "--no-first-run",
                                     "--disable-background-networking",
                                     "--disable-component-update",
                                     "--disable-sync",
                                     "--disable-dev-shm-usage",
                                     "--hide-scrollbars",
                                     "--window-size=" + std::to_string(width) + "," + std::to_string(height),
                                     "--user-data-dir=" + (folder / "profile"),
                                     "--screenshot=" + shot};
  arguments.insert(arguments.end(), drawing.begin(), drawing.end());
  arguments.push_back("file://" + (folder / "plot.html") + "#" + fragment);
  ChildProcess chromium(program, arguments, Output::kCaptured);
  if (!chromium.wait(kTimeout_s)) chromium.stop(1.0);
  std::error_code error;
  if (!fs::exists(shot)) throw std::runtime_error("chromium drew nothing: write .html instead");
  fs::copy_file(shot, path, fs::copy_options::overwrite_existing, error);
  if (error) throw std::runtime_error("cannot write " + path + ": " + error.message());
}

}  // namespace

void write_png(const std::string& path, const std::string& html, int width, int height) {
  shoot(path, html, "picture", {"--disable-gpu"}, width, height);
}

void write_page_png(const std::string& path, const std::string& html, const std::string& fragment, int width,
                    int height) {
  // The page's own time goes on until it has opened, however slow the machine is.
  constexpr const char* kPagesTime = "--virtual-time-budget=20000";
  shoot(path, html, fragment,
        {"--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", kPagesTime}, width,
        height);
}

}  // namespace sprung::log
