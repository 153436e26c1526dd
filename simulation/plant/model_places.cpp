#include "simulation/plant/model_places.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace sprung::sim {
namespace {

std::string without_comments(std::string text) {
  for (std::size_t at = 0; (at = text.find("<!--", at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find("-->", at), text.size());
    std::replace_if(
        text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(end),
        [](char c) { return c != '\n'; }, ' ');
  }
  return text;
}

}  // namespace

ModelPlaces::ModelPlaces(const std::string& path) : path_(path) {
  std::ifstream in(path);
  text_ = without_comments({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
}

std::string ModelPlaces::of(const std::string& element, const std::string& name) const {
  for (std::size_t at = 0; (at = text_.find("<" + element, at)) != std::string::npos; ++at) {
    const std::size_t end = text_.find('>', at);
    const std::string tag = text_.substr(at, end - at);
    if (tag.find(" name=\"" + name + "\"") == std::string::npos) continue;
    const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return path_ + ":" + std::to_string(lines + 1);
  }
  return path_;
}

}  // namespace sprung::sim
