#pragma once
/// sprung topics, watch, spy: they only listen, on the network of the robot that is up or on any other.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/command_line.h"
#include "tools/logs/fields/field_choice.h"
#include "tools/logs/fields/type_table.h"
#include "tools/logs/recorder/message_queue.h"
#include "tools/logs/recorder/network_tap.h"

namespace sprung::commands {

/// Options that the three share.
struct InspectRequest {
  std::string instance = "default";
  std::string url;                 ///< empty = of the robot that is up, else the default
  std::vector<std::string> types;  ///< .lcm files of types that are not sprung's
  std::string names_of;            ///< a log or a robot; empty = the robot that is up
};
void add_inspect_options(CommandLine& command, InspectRequest& request);

struct InspectSource {
  std::string url;
  std::string title;  ///< "pegasus, udpm://..."
  std::vector<fields::ListNames> names;
  std::unique_ptr<fields::TypeTable> types;
};
/// @throws NotRunning where an instance other than the default is asked for and is not up; WrongUse on a file
/// that is none.
InspectSource inspect_source(const InspectRequest& request);

/// Messages of the channels as they come.
class Listening {
 public:
  /// @param channels regular expression.
  Listening(const InspectSource& source, const std::string& channels) : tap_(source.url, channels, queue_) {}

  /// use(arrival_us, channel, data, size) of everything that came since the last call.
  template <class Use>
  void take(Use&& use) {
    queue_.take(batch_);
    batch_.for_each(use);
  }

  /// Messages that nobody saw, since what was shown before them was not taken in time.
  std::int64_t left_out() const { return queue_.left_out(); }

 private:
  /// Pegasus sends 1 MB/s: `sprung watch ... | less` may stand for a minute, and does not fill the memory in
  /// a night.
  static constexpr std::size_t kMostWaiting_bytes = std::size_t{64} << 20U;
  MessageQueue queue_{kMostWaiting_bytes};
  MessageQueue::Batch batch_;
  NetworkTap tap_;
};

void wait_or_stop(int wait_ms) noexcept;  ///< ends early when a stop is requested

/// LCM's own lcm-spy with sprung's types and plug-in; does not come back but on trouble. @param with_plots
/// opens torques and phases at once, else a double click on their channels does. @throws std::runtime_error
/// that says what to install.
[[noreturn]] void run_spy_gui(const InspectSource& source, bool with_plots);

}  // namespace sprung::commands
