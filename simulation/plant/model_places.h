#pragma once
/// Where in a model.xml an element of a name begins, for messages. Start-up only.
#include <string>

namespace sprung::sim {

class ModelPlaces {
 public:
  /// @param path of model.xml; what cannot be read has no lines.
  explicit ModelPlaces(const std::string& path);

  /// "robots/x/model.xml:57", the line of <element ... name="name">; the path alone where the file has none,
  /// as where it includes another one.
  /// @param element "body", "joint" or "geom"
  std::string of(const std::string& element, const std::string& name) const;
  const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
  std::string text_;  ///< comments blanked out
};

}  // namespace sprung::sim
