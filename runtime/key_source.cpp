#include "runtime/key_source.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "runtime/open_file.h"
#include "runtime/private_file.h"

namespace sprung {
namespace {

using KeyBytes = std::array<std::uint8_t, kKeyBytes>;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// Of a file from its begin, wherever others that share the descriptor have read to; of a pipe as it comes.
ssize_t read_some(int fd, std::uint8_t* out, std::size_t size, std::size_t at) noexcept {
  const ssize_t got = pread(fd, out, size, static_cast<off_t>(at));
  return got < 0 && errno == ESPIPE ? read(fd, out, size) : got;
}

/// @return false unless it holds exactly a key.
bool read_key(int fd, KeyBytes& key) noexcept {
  std::array<std::uint8_t, kKeyBytes + 1> bytes{};
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t got = read_some(fd, bytes.data() + count, bytes.size() - count, count);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    count += static_cast<std::size_t>(got);
  }
  std::copy_n(bytes.begin(), kKeyBytes, key.begin());
  explicit_bzero(bytes.data(), bytes.size());
  return count == kKeyBytes;
}

std::shared_ptr<const MessageKey> made_of(KeyBytes& bytes) {
  auto key = std::make_shared<const MessageKey>(bytes);
  explicit_bzero(bytes.data(), bytes.size());
  return key;
}

}  // namespace

std::shared_ptr<const MessageKey> random_key() {
  KeyBytes bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) fail("getrandom");
  return made_of(bytes);
}

std::shared_ptr<const MessageKey> read_key_fd(int fd) {
  KeyBytes bytes{};
  const bool good = read_key(fd, bytes);
  close(fd);
  if (!good)
    throw std::runtime_error("descriptor " + std::to_string(fd) + " holds no key of " +
                             std::to_string(kKeyBytes) +
                             " bytes: start this program by sprung up, or sprung run -- PROGRAM");
  return made_of(bytes);
}

std::shared_ptr<const MessageKey> read_key_file(const std::string& path) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (file.fd < 0 && errno == ELOOP) throw std::runtime_error("key " + path + " is not used: it is a link");
  if (file.fd < 0)
    throw std::runtime_error("key " + path + " cannot be read: " + std::strerror(errno) +
                             ". Who started the robot may command it");
  const std::string reason = why_not_private(file.fd, path, Others::kMayNothing);
  if (!reason.empty()) throw std::runtime_error("key " + path + " is not used: " + reason);
  KeyBytes bytes{};
  if (!read_key(file.fd, bytes))
    throw std::runtime_error("key " + path + " is not used: it does not hold " + std::to_string(kKeyBytes) +
                             " bytes. A new one: (umask 077; head -c 32 /dev/urandom > " + path + ")");
  return made_of(bytes);
}

void write_key_file(const std::string& path, const MessageKey& key) {
  unlink(path.c_str());  // of a run that was killed; a link there is not followed either
  const OpenFile file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  const bool written = file.fd >= 0 && fchmod(file.fd, S_IRUSR | S_IWUSR) == 0 &&
                       write(file.fd, key.bytes().data(), kKeyBytes) == static_cast<ssize_t>(kKeyBytes);
  if (!written) throw std::runtime_error("cannot write " + path + ": " + std::strerror(errno));
}

KeyFd::KeyFd(const MessageKey& key) : fd_(memfd_create("sprung key", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
  constexpr int kSeals = F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
  if (fd_ < 0) fail("memfd_create");
  if (write(fd_, key.bytes().data(), kKeyBytes) == static_cast<ssize_t>(kKeyBytes) &&
      lseek(fd_, 0, SEEK_SET) == 0 && fcntl(fd_, F_ADD_SEALS, kSeals) == 0)
    return;
  close(fd_);
  fail("key");
}

KeyFd::~KeyFd() { close(fd_); }

void KeyFd::inherit(int fd) noexcept { fcntl(fd, F_SETFD, 0); }

}  // namespace sprung
