#pragma once
/// What operators did, and who else tried: a line of JSON each, in a file on the robot. Datagrams that were
/// turned away come in floods, so they are counted, a line a second for each kind and sender.
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <utility>

namespace sprung::gateway {

class AuditLog {
 public:
  static constexpr std::uintmax_t kLongest = 10'000'000;  ///< then it becomes PATH.1, and a new one begins

  /// @throws std::runtime_error when it cannot be written.
  explicit AuditLog(std::string path);

  void event(const std::string& who, const std::string& from, const std::string& what);
  void turned(const std::string& why, const std::string& who, const std::string& from, std::int64_t now_us);
  /// Lines that are due. @param all of them, at the end.
  void step(std::int64_t now_us, bool all = false);

 private:
  struct Count {
    std::int64_t since_us = 0, count = 0;
    std::string from;
  };
  void open();
  void write(const std::string& line);
  std::string path_;
  std::ofstream out_;
  std::map<std::pair<std::string, std::string>, Count> turned_;
};

}  // namespace sprung::gateway
