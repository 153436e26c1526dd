#include "tools/logs/log/picture_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tools/operate/launcher/child_process.h"

namespace sprung::log {

namespace {

namespace fs = std::filesystem;

constexpr double kPatience_s = 60.0;

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
    throw std::runtime_error(std::string(error.what()) + "; or write .svg or .html, which need none");
  }
}

}  // namespace

void write_text_file(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path + ": " + std::strerror(errno));
}

void write_png(const std::string& path, const std::string& svg, int width, int height) {
  const std::string program = browser();
  const ScratchFolder folder;
  write_text_file(folder / "plot.html",
                  "<!DOCTYPE html><meta charset=\"utf-8\"><body style=\"margin:0\">" + svg);
  const std::string shot = folder / "plot.png";
  ChildProcess chromium(
      program,
      {"--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
       "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars",
       "--window-size=" + std::to_string(width) + "," + std::to_string(height),
       "--user-data-dir=" + (folder / "profile"), "--screenshot=" + shot, "file://" + (folder / "plot.html")},
      Output::kCaptured);
  if (!chromium.wait(kPatience_s)) chromium.stop(1.0);
  std::error_code error;
  if (!fs::exists(shot)) throw std::runtime_error("chromium drew nothing: write .svg or .html instead");
  fs::copy_file(shot, path, fs::copy_options::overwrite_existing, error);
  if (error) throw std::runtime_error("cannot write " + path + ": " + error.message());
}

}  // namespace sprung::log
