#include "tools/lab/identify/file_digest.h"

#include <sha2.h>

#include <array>
#include <stdexcept>

namespace sprung::identify {

std::string short_sha256(const std::string& path) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
  if (SHA256File(path.c_str(), text.data()) == nullptr)
    throw std::runtime_error("cannot read " + path + ": does it exist?");
  return std::string(text.data(), 16);
}

}  // namespace sprung::identify
