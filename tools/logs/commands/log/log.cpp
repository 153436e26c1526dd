#include <cstdio>
#include <filesystem>
#include <memory>

#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/log/field_hint.h"

namespace sprung::commands {

log::Progress progress_line(const std::string& label) {
  return [bar = std::make_shared<ProgressBar>(label)](std::uint64_t done, std::uint64_t all) {
    constexpr std::uint64_t kMega = 1'000'000;
    bar->show(done / kMega, all / kMega);
  };
}

std::string beside(const std::string& log, const std::string& ending) {
  return std::filesystem::path(log).stem().string() + ending;
}

void tell_no_event(const std::string& log) {
  std::fprintf(stderr, "%s holds no event: is it an LCM log?\n", log.c_str());
}

int tell_rewrite(const std::string& log, const std::string& out, const log::RewriteResult& result) {
  std::printf("%s: %lld of %lld events, %llu bytes\n", out.c_str(), static_cast<long long>(result.written),
              static_cast<long long>(result.read), static_cast<unsigned long long>(result.bytes));
  if (result.damages > 0 || result.refused > 0) {
    std::printf("left out: %llu damaged places with %llu bytes, %lld messages that are none\n",
                static_cast<unsigned long long>(result.damages),
                static_cast<unsigned long long>(result.skipped_bytes),
                static_cast<long long>(result.refused));
  }
  if (result.read == 0 && result.skipped_bytes > 0) {
    tell_no_event(log);
    return kExitFailed;
  }
  if (result.read > 0 && result.written == result.brought) {
    std::fprintf(stderr, "%s has nothing in that time and on those channels: sprung log info lists both\n",
                 log.c_str());
    return kExitFailed;
  }
  return kExitDone;
}

log::RobotNames names_or_told(log::Reader& reader) {
  log::RobotNames names = log::names_in_log(reader);
  if (!names.missing.empty()) std::fprintf(stderr, "%s\n", names.missing.c_str());
  return names;
}

void tell_unmatched(const std::string& log, const std::vector<std::string>& fields) {
  for (const std::string& field : fields)
    std::fprintf(stderr, "%s\n", log::no_field_text(log, field).c_str());
}

void add_log(CommandLine& sprung) {
  CommandLine& log = sprung.subcommand("log", "Look into LCM logs, and make other files of them.");
  log.example("sprung log info logs/pegasus.lcm");
  add_log_info(log);
  add_log_cut(log);
  add_log_merge(log);
  add_log_verify(log);
  add_log_repair(log);
  add_log_csv(log);
  add_log_mcap(log);
  add_log_plot(log);
  add_log_diff(log);
}

}  // namespace sprung::commands
