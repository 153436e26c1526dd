#pragma once
/// Pictures on the disk. Shell: writes files, runs a browser.
#include <string>

namespace sprung::log {

/// @throws std::runtime_error naming the file and why it failed.
void write_text_file(const std::string& path, const std::string& text);

/// An SVG picture as PNG, drawn by Debian's Chromium without a screen. @param width, height px.
/// @throws std::runtime_error where chromium is missing (saying what to install, and that SVG and HTML need
/// none), or wrote nothing.
void write_png(const std::string& path, const std::string& svg, int width, int height);

}  // namespace sprung::log
