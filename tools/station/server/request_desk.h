#pragma once
/// Operator commands that are under way: said again until they are answered and asked after until they are
/// over, as OperatorClient does for one (tools/operate/client/operator_client.h). Pure; times are the
/// session's us.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signals/operator.h"

namespace sprung::station {

/// Who asked, and the number that he gave it.
struct Asker {
  int page = -1;  ///< -1: nobody waits for an answer
  std::int64_t number = 0;
};

/// An OPERATOR_REPLY.
struct RobotAnswer {
  std::int64_t request_id = 0;
  OperatorOutcome outcome = OperatorOutcome::kRefused;
  std::string reason;
  std::string from;
  std::int64_t cycle = -1;
  std::int64_t parameter = 0;  ///< id of the one that was set or read; 0: none
  double parameter_value = kNaN;
};

struct RequestNews {
  Asker asker;
  OperatorKind kind = OperatorKind::kNone;
  std::string outcome;  ///< name of an OperatorOutcome, or "no answer"
  std::string reason;
  std::int64_t cycle = -1;
  bool over = false;  ///< nothing more will be said of it
  bool went_well() const { return outcome != "refused" && outcome != "failed" && outcome != "no answer"; }
};

class RequestDesk {
 public:
  static constexpr std::size_t kMost = 32;
  static constexpr std::int64_t kSayAgain_us = 100'000;
  static constexpr std::int64_t kAskAgain_us = 500'000;
  static constexpr std::int64_t kFirstAnswer_us = 3'000'000;
  static constexpr std::int64_t kSilence_us = 5'000'000;

  /// @param salt of this desk's request ids: two operators must not choose the same.
  explicit RequestDesk(std::uint64_t salt) : salt_(salt) {}

  /// nullopt: too many are under way. @return its request id; it is handed out by the next step(). What a
  /// command makes void and nobody has answered yet is said no more, lest it comes after it: a stop, sit or
  /// estop makes void whatever moves the robot, a walk, hold or enable the one before it,
  /// and a hold that lets go whatever moves too. Holds and enables are said once: the next is as good, and
  /// one that comes after its time would let the robot move when nobody holds.
  std::optional<std::int64_t> add(OperatorCommand command, const Asker& asker, std::int64_t now_us);
  /// nullopt: nobody asked, or it has been told.
  std::optional<RequestNews> answer(const RobotAnswer& answer, std::int64_t now_us);
  /// What is to be sent now, and what has come to an end without an answer.
  void step(std::int64_t now_us, std::vector<OperatorCommand>& send, std::vector<RequestNews>& news);
  std::size_t under_way() const noexcept { return requests_.size(); }

 private:
  struct Request {
    OperatorCommand command;
    Asker asker;
    bool answered = false;
    std::int64_t send_us = 0;
    std::int64_t give_up_us = 0;
    std::string told;
  };
  std::int64_t next_id(std::int64_t now_us) noexcept;
  void drop_what_is_void(const OperatorCommand& by);

  std::uint64_t salt_;
  std::int64_t last_id_ = 0;
  std::vector<Request> requests_;
  std::vector<RequestNews> dropped_;
};

}  // namespace sprung::station
