#include "tools/logs/incident/bundle.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tools/common/report/report_shell.h"
#include "tools/logs/incident/log_choice.h"
#include "tools/logs/incident/log_stretch.h"
#include "tools/logs/log/info_text.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung::log {

namespace {

namespace fs = std::filesystem;

constexpr double kAfterCause_s = 5.0;  // what safety did about it
constexpr double kTar_s = 600.0;       // a long stretch on a slow disk

/// A folder that is gone again, with all that is in it, unless it was kept.
class NewFolder {
 public:
  explicit NewFolder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    if (fs::exists(path_, error))
      throw std::runtime_error(path_.string() + " is there already: remove it, or name another with --out");
    if (!fs::create_directories(path_, error))
      throw std::runtime_error("cannot make the folder " + path_.string() + ": " + error.message() +
                               "; name another place with --out");
  }
  ~NewFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  void keep() noexcept { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

/// What is known of the incident so far.
struct Findings {
  std::vector<LogInfo> logs;  ///< in the bundle; newest first, one around an older cause last
  std::string cause;
};

bool holds_events(const std::vector<LogInfo>& logs) {
  return std::any_of(logs.begin(), logs.end(),
                     [](const LogInfo& info) { return info.events > (info.metadata ? 1 : 0); });
}

/// The newest trip in the logs that were copied, with its text; one that began before them does not count.
bool tell_trip(Findings& findings) {
  for (const LogInfo& info : findings.logs) {
    const auto trip = last_trip(info.incidents);
    if (!trip || trip->from_before) continue;
    findings.cause = trip_text(trip, info.path);
    return true;
  }
  return false;
}

/// The stop is older than what was copied: what was around its beginning comes along.
void bring_older_trip(const std::vector<std::string>& parts, double last_s, const NewFolder& folder,
                      Findings& findings, const Progress& progress) {
  const auto found = find_trip(parts, progress);
  if (!found) return;
  const double at_s = found->trip.first.time_s;
  const std::string name = "cause-" + fs::path(found->log).filename().string();
  findings.logs.push_back(copy_stretch({found->log, std::max(0.0, at_s - last_s), at_s + kAfterCause_s},
                                       folder / name, progress));
  findings.cause = trip_text(found->trip, found->log) + "that is in " + name + "\n";
}

Findings gather_logs(const BundleRequest& request, const NewFolder& folder, const Progress& progress) {
  const std::vector<std::string> parts = parts_back_from(request.log);
  Findings findings{copy_last(parts, request.last_s, folder.path(), progress), ""};
  if (!holds_events(findings.logs))
    throw std::runtime_error(request.log + " holds no event: is it an LCM log?");
  if (tell_trip(findings)) return findings;
  bring_older_trip(parts, request.last_s, folder, findings, progress);
  if (findings.cause.empty())
    findings.cause = trip_text(last_trip(findings.logs.front().incidents), findings.logs.front().path);
  return findings;
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A process that died says nothing in the log; its launcher does. "" where no line tells of an error.
std::string last_error(const std::string& lines) {
  const std::size_t at = lines.rfind(" error ");
  if (at == std::string::npos) return "";
  const std::size_t begin = lines.rfind('\n', at) + 1;  // npos + 1 is 0, the first line
  return "last error: " + lines.substr(begin, lines.find('\n', at) - begin) + "\n";
}

std::string incident_text(const BundleRequest& request, const Findings& findings) {
  std::string out = findings.cause + "\nout of " + fs::absolute(request.log).string() +
                    (request.run_file.empty() ? ", no robot was up\n" : ", the robot was up: run.json\n");
  out += "\nversions of the machine on which this was put together\n" + versions_text();
  for (const LogInfo& info : findings.logs) out += "\n" + info_text(info, {true});
  return out;
}

/// Of the log; of another program's log there is none.
std::string robot_yaml(const std::vector<LogInfo>& logs) {
  for (const LogInfo& info : logs)
    if (info.metadata && !info.metadata->robot_yaml.empty()) return info.metadata->robot_yaml;
  return "";
}

void write_texts(const BundleRequest& request, Findings& findings, const NewFolder& folder) {
  const std::string file = lines_beside(request.log);
  const std::string lines = file.empty() ? "" : text_of(file);
  findings.cause += last_error(lines);
  report::write_text(incident_text(request, findings), folder / "incident.txt");
  const std::string robot = robot_yaml(findings.logs);
  if (!robot.empty()) report::write_text(robot, folder / "robot.yaml");
  if (!lines.empty()) report::write_text(lines, folder / "lines.txt");
  if (!request.run_file.empty()) report::write_text(text_of(request.run_file), folder / "run.json");
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void pack(const std::string& folder, const std::string& archive) {
  const fs::path path = fs::absolute(folder);
  ChildProcess tar(system_program("tar", "tar"),
                   {"-czf", archive, "-C", path.parent_path().string(), path.filename().string()},
                   Output::kCaptured);
  const bool ended = tar.wait(kTar_s);
  const int status = ended ? *tar.ended() : tar.stop(1.0);
  if (status == 0) return;
  std::error_code ignored;
  fs::remove(archive, ignored);
  throw std::runtime_error("tar could not write " + archive + (ended ? ": " + tar.output() : " in time\n") +
                           "a folder needs no tar: --out FOLDER");
}

}  // namespace

bool is_archive(const std::string& path) {
  const std::string ending = kArchiveEnding;
  return path.size() > ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

Bundle write_bundle(const BundleRequest& request, const Progress& progress) {
  const bool archive = is_archive(request.out);
  if (archive && fs::exists(request.out))
    throw std::runtime_error(request.out + " is there already: remove it, or name another with --out");
  const std::string ending = kArchiveEnding;
  NewFolder folder(archive ? request.out.substr(0, request.out.size() - ending.size()) : request.out);
  Findings findings = gather_logs(request, folder, progress);
  write_texts(request, findings, folder);
  Bundle bundle{names_in(folder.path()), findings.cause};
  if (archive)
    pack(folder.path(), request.out);
  else
    folder.keep();
  return bundle;
}

}  // namespace sprung::log
