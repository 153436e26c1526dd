#include "tools/operate/launcher/run_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace sprung {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kOwnerAlone = S_IRWXU;

/// In /tmp, where every user may make any name.
bool is_in_tmp() {
  return std::getenv("SPRUNG_RUN_DIR") == nullptr && std::getenv("XDG_RUNTIME_DIR") == nullptr;
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& why, const std::string& remedy) {
  throw std::runtime_error(folder.string() + " is not used: " + why +
                           ", so that somebody else could say which robot is up. " + remedy +
                           ", or choose another folder: export SPRUNG_RUN_DIR=FOLDER");
}

}  // namespace

fs::path run_folder() {
  if (const char* folder = std::getenv("SPRUNG_RUN_DIR")) return folder;
  if (const char* folder = std::getenv("XDG_RUNTIME_DIR")) return fs::path(folder) / "sprung";
  return "/tmp/sprung-" + std::to_string(getuid());
}

void require_private(const fs::path& folder) {
  struct stat found {};
  if (lstat(folder.c_str(), &found) != 0) {
    if (errno == ENOENT) return;
    throw std::runtime_error("cannot look at " + folder.string() + ": " + std::strerror(errno));
  }
  const std::string name = folder.string();
  if (!S_ISDIR(found.st_mode))
    refuse(folder, S_ISLNK(found.st_mode) ? "it is a link" : "it is no folder", "Remove it: rm " + name);
  if (found.st_uid != getuid())
    refuse(folder, "it belongs to user " + std::to_string(found.st_uid), "Remove it: sudo rm -r " + name);
  if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    refuse(folder, "others may write into it", "Take that right away: chmod 700 " + name);
}

void make_private(const fs::path& folder) {
  if (mkdir(folder.c_str(), kOwnerAlone) != 0 && errno != EEXIST)
    throw std::runtime_error("cannot make " + folder.string() + ": " + std::strerror(errno) +
                             "; choose another folder: export SPRUNG_RUN_DIR=FOLDER");
  require_private(folder);
}

fs::path checked_run_folder() {
  fs::path folder = run_folder();
  if (is_in_tmp()) require_private(folder);
  return folder;
}

fs::path made_run_folder() {
  fs::path folder = run_folder();
  if (is_in_tmp())
    make_private(folder);
  else
    fs::create_directories(folder);
  return folder;
}

}  // namespace sprung
