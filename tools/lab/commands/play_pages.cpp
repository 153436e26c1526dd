#include "tools/lab/commands/play_pages.h"

#include <filesystem>

#include "tools/common/report/report_shell.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/recorder/inprocess_log.h"
#include "tools/station/play/log_page.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;

thread_local const InProcessRobot::ObserverSource* logs_of_this_thread = nullptr;

/// Logs of the robots that this thread makes while it is there; then they are gone.
class PassingLogs {
 public:
  explicit PassingLogs(fs::path folder)
      : folder_(emptied(std::move(folder))), source_(logs_into(folder_.string(), "sprung experiment")) {
    logs_of_this_thread = &source_;
  }
  ~PassingLogs() {
    logs_of_this_thread = nullptr;
    std::error_code left;
    fs::remove_all(folder_, left);
  }
  PassingLogs(const PassingLogs&) = delete;
  PassingLogs& operator=(const PassingLogs&) = delete;

  /// Empty where no robot was made.
  fs::path first() const {
    fs::path out;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (out.empty() || entry.path() < out) out = entry.path();
    return out;
  }

 private:
  static fs::path emptied(fs::path folder) {
    fs::remove_all(folder);  // of a run that was killed
    return folder;
  }

  fs::path folder_;
  InProcessRobot::ObserverSource source_;
};

}  // namespace

std::unique_ptr<InProcessObserver> observer_for_page(const RobotConfig& robot, const std::string& preset,
                                                     const SimOptions& sim) {
  return logs_of_this_thread != nullptr ? (*logs_of_this_thread)(robot, preset, sim) : nullptr;
}

PlayPage play_pages_into(const std::string& folder) {
  return [folder](const std::string& name, const std::function<void()>& again) -> std::string {
    const PassingLogs logs(fs::path(folder) / (name + ".logs"));
    again();
    const fs::path log = logs.first();
    if (log.empty()) return "";
    log::Reader reader(log.string());
    std::string page = name + ".html";
    report::write_text(station::make_log_page(reader).html, fs::path(folder) / page);
    return page;
  };
}

}  // namespace sprung::commands
