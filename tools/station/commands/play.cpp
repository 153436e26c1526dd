#include <cstdio>
#include <filesystem>
#include <memory>

#include "tools/commands.h"
#include "tools/common/report/report_shell.h"
#include "tools/logs/log/picture_file.h"
#include "tools/logs/log/reader.h"
#include "tools/station/play/log_page.h"
#include "tools/station/video/log_video.h"

namespace sprung::commands {

namespace {

struct PlayLine {
  std::string log;
  std::string out;
  std::string png;
  std::string video;
  double speed = 1.0;
  double at_s = 0.0;
  int width_px = 1280, height_px = 720;
};

void check(const PlayLine& line) {
  namespace fs = std::filesystem;
  const auto ends_in = [](const std::string& path, const char* ending) {
    return path.empty() || fs::path(path).extension() == ending;
  };
  if (!ends_in(line.out, ".html")) throw WrongUse("-o " + line.out + ": its name ends in .html");
  if (!ends_in(line.png, ".png")) throw WrongUse("--png " + line.png + ": its name ends in .png");
  if (!line.video.empty() && !(line.speed > 0.0 && line.speed <= 100.0))
    throw WrongUse("--speed is above 0, 100 at most");
  constexpr int kLeast_px = 320, kMost_px = 4096;
  const auto fits = [](int px) { return px >= kLeast_px && px <= kMost_px; };
  if (!fits(line.width_px) || !fits(line.height_px))
    throw WrongUse("--width and --height are 320 to 4096 pixels");
}

void write_picture(const PlayLine& line, const station::LogPage& page) {
  char at[40];
  std::snprintf(at, sizeof at, "at=%.6f", line.at_s);
  log::write_page_png(line.png, page.html, at, line.width_px, line.height_px);
  std::printf("%s\n", line.png.c_str());
}

void write_video(const PlayLine& line, log::Reader& reader) {
  station::VideoOptions options;
  options.width = line.width_px / 2 * 2;  // ffmpeg's usual format has a colour for each 2 x 2
  options.height = line.height_px / 2 * 2;
  options.speed = line.speed;
  const station::VideoResult result = station::write_video(reader, line.video, options);
  reader.rewind();
  for (const std::string& note : result.notes) std::printf("%s\n", note.c_str());
  std::printf("%s: %zu pictures, %d a second\n", line.video.c_str(), result.pictures,
              options.frames_a_second);
}

int run_play(const PlayLine& line) {
  check(line);
  log::Reader reader(line.log);
  if (!line.video.empty()) write_video(line, reader);
  if (!line.video.empty() && line.out.empty() && line.png.empty()) return kExitDone;
  const station::LogPage page = station::make_log_page(reader);
  for (const std::string& note : page.notes) std::printf("%s\n", note.c_str());
  if (!line.png.empty()) write_picture(line, page);
  if (!line.png.empty() && line.out.empty()) return kExitDone;
  const std::string out = line.out.empty() ? std::filesystem::path(line.log).stem().string() + ".html"
                                           : line.out;
  report::write_text(page.html, out);
  std::printf("%s: open it in a browser\n", out.c_str());
  return kExitDone;
}

}  // namespace

void add_play(CommandLine& sprung) {
  const auto line = std::make_shared<PlayLine>();
  CommandLine& play = sprung.subcommand(
      "play",
      "A log as one page that shows the robot in 3-D, with forces, torques, plots and a time slider.");
  play.option("log", line->log, "LCM log", Need::kRequired);
  play.option("-o,--output", line->out, "x.html; default: named after the log, in this folder");
  play.option("--png", line->png, "x.png: a picture of the page instead, as Chromium draws it");
  play.option("--at", line->at_s, "of the picture, s since the log's begin");
  play.option("--video", line->video, "x.mp4: a video of the robot instead, drawn by MuJoCo, made by ffmpeg");
  play.option("--speed", line->speed, "of the video; 0.25: four times as slow as it was");
  play.option("--width", line->width_px, "of the picture or video, px");
  play.option("--height", line->height_px, "likewise");
  play.example("sprung play logs/single_leg.lcm -o jump.html");
  play.action([=] { return run_play(*line); });
}

}  // namespace sprung::commands
