#pragma once
/// The files of the live page, built into the program. Pure.
#include <string_view>

namespace sprung::station {

struct WebFile {
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string_view bytes;
};

/// @param path behind the token; "" is the page itself. nullptr: there is no such file.
const WebFile* console_file(std::string_view path);

}  // namespace sprung::station
