#include "runtime/private_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "runtime/open_file.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + " " + why);
}

void make_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code ignored;
  if (!folder.empty()) fs::create_directories(folder, ignored);
}

bool write_all(int fd, const std::string& text) {
  return fchmod(fd, S_IRUSR | S_IWUSR) == 0 &&
         write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

}  // namespace

std::string why_not_private(int fd, const std::string& path, Others others) {
  struct stat found {};
  if (fstat(fd, &found) != 0) return std::strerror(errno);
  if (!S_ISREG(found.st_mode)) return "it is no file";
  if (found.st_uid != geteuid() && geteuid() != 0)
    return "it belongs to user " + std::to_string(found.st_uid);
  const mode_t too_much = others == Others::kMayRead ? S_IWGRP | S_IWOTH : S_IRWXG | S_IRWXO;
  if ((found.st_mode & too_much) == 0) return "";
  return (others == Others::kMayRead ? "others may write it: chmod 600 " : "others may read it: chmod 600 ") +
         path;
}

std::string read_private_file(const std::string& path, Others others) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (file.fd < 0 && errno == ELOOP) refuse(path, "is not used: it is a link");
  if (file.fd < 0) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
  const std::string reason = why_not_private(file.fd, path, others);
  if (!reason.empty()) refuse(path, "is not used: " + reason);
  std::string text;
  char part[4096];
  for (ssize_t got = 0; (got = read(file.fd, part, sizeof part)) > 0;)
    text.append(part, static_cast<std::size_t>(got));
  return text;
}

void make_private_file(const std::string& path, const std::string& text) {
  make_folder_of(path);
  const OpenFile file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (file.fd < 0 && errno == EEXIST) refuse(path, "is there already: move it away, or name another file");
  if (file.fd < 0 || !write_all(file.fd, text))
    refuse(path, std::string("cannot be written: ") + std::strerror(errno));
}

void write_private_file(const std::string& path, const std::string& text) {
  const std::string draft = path + "." + std::to_string(getpid());
  unlink(draft.c_str());  // of one that was killed
  make_private_file(draft, text);
  fs::rename(draft, path);
}

std::string state_folder() {
  if (const char* folder = std::getenv("SPRUNG_STATE_DIR")) return folder;
  if (const char* home = std::getenv("HOME")) return std::string(home) + "/.local/state/sprung";
  return "";
}

}  // namespace sprung
