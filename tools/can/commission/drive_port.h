#pragma once
/// The two that commissioning talks to: the bus that a drive hangs on, and the person beside the machine.
/// Real ones are shells; simulated ones play both hermetically.
#include <string>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/canopen/protocol.h"
#include "signals/enumeration.h"
#include "tools/can/sdo_session.h"

namespace sprung::commission {

/// One bus on which this is the only master. Calls wait for their answers.
class DrivePort {
 public:
  static constexpr double kCycle_s = 0.005;  ///< of SYNC and heartbeat while a motor has power
  virtual ~DrivePort() = default;
  DrivePort(const DrivePort&) = delete;
  DrivePort& operator=(const DrivePort&) = delete;

  virtual SdoAnswer read(int node, canopen::ObjectId object) = 0;
  virtual SdoAnswer write(int node, canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) = 0;
  virtual void send(const CanFrame& frame) = 0;
  /// This master's heartbeat and SYNC, when kCycle_s have passed since the last ones.
  virtual void beat() = 0;
  virtual void wait(double seconds) = 0;
  virtual double now_s() const = 0;
  /// Ids that answer, once for each answer: an id that is there twice is two devices.
  virtual std::vector<int> nodes() = 0;
  /// Boot-up messages of a node, heard since the port was opened.
  virtual int boot_ups(int node) const = 0;
  /// Ctrl-C.
  virtual bool stopped() const = 0;

 protected:
  DrivePort() = default;
};

/// What a person is asked to do or to say.
enum class Ask : std::int8_t {
  kTurn,            ///< the joint by hand, forward; the answer is the angle, rad
  kTurnBack,        ///< to where it was
  kPressEmergency,  ///< the answer means nothing
  kReleaseEmergency,
  kBrake,       ///< 1: a brake holds the motor without power, 0: none
  kPower,       ///< power may come on: 1
  kHangWeight,  ///< the answer is its torque about the joint, Nm; 0: there is none
  kTakeWeight,
  kWrite,  ///< robot.yaml's value may be written: 1
  kStore,  ///< what was written may be stored in the drive: 1
};
constexpr auto words_of(Ask) {
  using E = Ask;
  return words<E>({{E::kTurn, "turn"},
                   {E::kTurnBack, "turn_back"},
                   {E::kPressEmergency, "press_emergency"},
                   {E::kReleaseEmergency, "release_emergency"},
                   {E::kBrake, "brake"},
                   {E::kPower, "power"},
                   {E::kHangWeight, "hang_weight"},
                   {E::kTakeWeight, "take_weight"},
                   {E::kWrite, "write"},
                   {E::kStore, "store"}});
}

struct Question {
  Ask ask = Ask::kPower;
  std::string text{};
  double suggested = 1.0;  ///< what Enter answers
};

class Person {
 public:
  virtual ~Person() = default;
  Person(const Person&) = delete;
  Person& operator=(const Person&) = delete;

  /// Comes back when it is done. @return NaN: not done, leave this step.
  virtual double answer(const Question& question) = 0;
  /// A step begins.
  virtual void begins(const std::string& step) = 0;
  /// A step is over.
  virtual void hears(const std::string& text) = 0;

 protected:
  Person() = default;
};

}  // namespace sprung::commission
