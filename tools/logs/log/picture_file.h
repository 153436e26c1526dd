#pragma once
/// Pictures on the disk. Shell: writes files, runs a browser.
#include <string>

namespace sprung::log {

/// A report's page (tools/common/report) as PNG, as Debian's Chromium draws it without a screen: title,
/// subtitle and plots share the picture's height. @param width, height px.
/// @throws std::runtime_error where chromium is missing (saying what to install, and that HTML needs none),
/// or wrote nothing.
void write_png(const std::string& path, const std::string& html, int width, int height);

/// A page that draws in 3-D and takes its time to open (tools/station), as write_png draws a report: by
/// software where there is no graphics card.
/// @param fragment behind the address, "at=12.3". @throws as write_png.
void write_page_png(const std::string& path, const std::string& html, const std::string& fragment, int width,
                    int height);

}  // namespace sprung::log
