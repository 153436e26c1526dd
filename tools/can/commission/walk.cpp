#include "tools/can/commission/walk.h"

#include <cstring>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/sdo_aborts.h"
#include "drivers/profiles/profile_eds.h"
#include "tools/can/decode/object_value.h"

namespace sprung::commission {
namespace {

const JointConfig& joint_of(const RobotConfig& robot, int actuator) {
  const int joint = robot.joint_of_actuator(actuator);
  if (joint < 0)
    throw std::invalid_argument("no leg of " + robot.name + " has this drive: `legs` of robot.yaml");
  return robot.joints[static_cast<std::size_t>(joint)];
}

}  // namespace

Walk::Walk(const RobotConfig& robot, int actuator, const DriveTiming& timing, const WalkOptions& options,
           DrivePort& port, Person& person)
    : robot_(robot),
      actuator_(robot.actuators.at(static_cast<std::size_t>(actuator))),
      joint_(joint_of(robot, actuator)),
      options_(options),
      port_(port),
      person_(person),
      profile_(make_profile(actuator_, timing)),
      plan_(profile_->commissioning(robot.bit_rate_bit_s)),
      eds_(profile_eds(*find_profile_kind(actuator_.profile), actuator_.node)),
      boot_ups_(port.boot_ups(actuator_.node)),
      friction_Nm_(breakaway_Nm(joint_.estimated_friction())) {
  protocol_.drive = actuator_.name + ": node " + std::to_string(actuator_.node) + " on " +
                    robot.buses[static_cast<std::size_t>(actuator_.bus)].name;
}

Protocol Walk::run() {
  try {
    all_steps();
    protocol_.finished = true;
  } catch (const Ended&) {
    end_step();
  } catch (const DriveLost& lost) {
    finding({"the drive", "answers", lost.what(), Verdict::kDiffers,
             "mend supply and cable, then run this again from the start"});
    end_step();
  } catch (...) {
    switch_off();
    throw;
  }
  switch_off();
  for (const std::string& value : values_written_)
    protocol_.written.push_back(value + ", not stored: gone when the drive's power goes");
  return protocol_;
}

void Walk::all_steps() {
  step("node id", &Walk::node_id);
  step("maker and firmware", &Walk::identity);
  step("errors and supply", &Walk::errors);
  step("stored configuration", &Walk::stored);
  step("motor", &Walk::motor);
  step("encoder", &Walk::encoder);
  step("current loop gains", &Walk::current_gains);
  step("limits", &Walk::limits);
  step("bus settings", &Walk::bus_settings);
  store_written();
  step("brake", &Walk::brake);
  step("emergency input", &Walk::emergency_input);
  step("turned by hand", &Walk::turned_by_hand);
  if (!options_.power || any_difference()) throw Ended{};
  step("power", &Walk::power);
  step("current step", &Walk::current_step);
  step("commutation and signs", &Walk::commutation);
  step("torque constant", &Walk::torque_constant);
}

/// A step with power that differs is the last one.
void Walk::step(const char* name, void (Walk::*work)()) {
  begin_step(name);
  (this->*work)();
  check_drive();
  const bool last = powered_ && current_.verdict() == Verdict::kDiffers;
  end_step();
  if (last) throw Ended{};
}

void Walk::begin_step(const char* name) {
  current_ = Step{name};
  person_.begins(name);
}

void Walk::end_step() {
  if (current_.name.empty()) return;
  person_.hears(step_text(current_));
  protocol_.steps.push_back(current_);
  current_ = Step{};
}

bool Walk::any_difference() const { return !protocol_.first_difference().empty(); }

/// Values that are not stored are gone when a drive starts again, whoever wrote them.
void Walk::check_drive() {
  if (port_.stopped()) throw DriveLost("stopped by the operator");
  if (port_.boot_ups(actuator_.node) != boot_ups_)
    throw DriveLost("it started again in the middle: its supply dropped, and what was not stored is lost");
}

SdoAnswer Walk::ask_drive(canopen::ObjectId object) {
  SdoAnswer answer = port_.read(actuator_.node, object);
  if (answer.status == canopen::SdoStatus::kTimeout) {
    if (port_.stopped()) throw DriveLost("stopped by the operator");
    throw DriveLost("no answer to a read of " + named(object) + ": power or cable is gone");
  }
  return answer;
}

std::optional<std::int64_t> Walk::number(canopen::ObjectId object, bool is_signed) {
  const SdoAnswer answer = ask_drive(object);
  if (!answer.done()) return std::nullopt;
  return cantools::number_of(answer.bytes.data(), std::min<std::size_t>(answer.bytes.size(), 8), is_signed);
}

bool Walk::write(canopen::ObjectId object, std::int64_t value, int size) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  const SdoAnswer answer = port_.write(actuator_.node, object, bytes);
  if (answer.status == canopen::SdoStatus::kTimeout)
    throw DriveLost("no answer to a write of " + named(object) + ": it may or may not be in force");
  return answer.done();
}

std::string Walk::value_text(canopen::ObjectId object, std::int64_t value, int size) const {
  std::uint8_t bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  return cantools::with_unit(
      cantools::object_value(eds_.find(object), object, bytes, static_cast<std::size_t>(size)));
}

std::string Walk::named(canopen::ObjectId object) const {
  return canopen::id_text(object) + " " +
         (eds_.find(object) != nullptr ? eds_.name_of(object) : canopen::object_name(object.index));
}

double Walk::ask(Ask what, std::string text, double suggested) {
  const double answer = person_.answer({what, std::move(text), suggested});
  check_drive();
  return answer;
}

}  // namespace sprung::commission
