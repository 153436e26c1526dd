#pragma once
/// The files of the live page, built into the program. Pure.
#include <string>
#include <string_view>

namespace sprung::station {

struct WebFile {
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string_view bytes;
};

/// The page itself. @param nonce by which its server lets the script that stands in it run.
std::string console_page(const std::string& nonce);

/// What the page asks for. @param path behind the token. nullptr: there is no such file.
const WebFile* console_file(std::string_view path);

}  // namespace sprung::station
