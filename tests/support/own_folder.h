#pragma once
/// A folder for the files of one test, empty at first and gone with the object. No two tests ever have the
/// same, not those of another build, checkout or user, nor one that was killed and left its files.
#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace sprung::test {

class OwnFolder {
 public:
  explicit OwnFolder(const std::string& name) {
    std::string pattern = (std::filesystem::temp_directory_path() / ("sprung-" + name + "-XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make the folder " + pattern);
    path_ = pattern;
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// "FOLDER/": one for all tests of this program, gone with its process.
inline const std::string& temp_dir() {
  static const OwnFolder folder("tests");
  static const std::string with_slash = folder.path().string() + "/";
  return with_slash;
}

}  // namespace sprung::test
