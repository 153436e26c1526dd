#include "tools/operate/client/parameter_client.h"

#include <algorithm>
#include <stdexcept>

#include "robots/overlay.h"
#include "robots/robot_loader.h"
#include "signals/number_text.h"

namespace sprung {
namespace {

constexpr double kParameterAnswer_s = 3.0;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

}  // namespace

ParameterClient::ParameterClient(const RunInfo& info)
    : robot_(load_robot(info.robot_folder)),
      preset_(robot_.preset(info.preset).name),
      parameters_(parameters_of(robot_, robot_.preset(info.preset))),
      client_(info) {}

OperatorAnswer ParameterClient::next_changed(std::int64_t behind) {
  OperatorCommand question;
  question.kind = OperatorKind::kReadParameter;
  question.parameter = behind;
  const auto answer = client_.send(question, kParameterAnswer_s);
  if (!answer) throw std::runtime_error("the motion planner does not answer; see: sprung status");
  if (answer->outcome == OperatorOutcome::kRefused) throw std::runtime_error(answer->reason);
  return *answer;
}

std::vector<double> ParameterClient::read() {
  std::vector<double> values;
  for (const Parameter& one : parameters_) values.push_back(one.file);
  std::size_t asked = 0;
  for (OperatorAnswer found = next_changed(0); found.parameter != 0; found = next_changed(found.parameter)) {
    const auto place = place_of(parameters_, found.parameter);
    if (!place || ++asked > values.size())
      throw std::runtime_error("the robot that is up has other parameters than " + robot_.folder +
                               "/robot.yaml: was that changed since?");
    values[*place] = found.parameter_value;
  }
  return values;
}

std::optional<OperatorAnswer> ParameterClient::set(const Parameter& parameter, double value) {
  OperatorCommand order;
  order.kind = OperatorKind::kSetParameter;
  order.parameter = parameter.id;
  order.parameter_value = value;
  return client_.send(order, kParameterAnswer_s);
}

std::vector<OverlaidNumber> ParameterClient::overlay(const std::vector<double>& values) const {
  std::vector<OverlaidNumber> out;
  const auto is_ours = [&](const OverlaidNumber& known) {
    return std::any_of(parameters_.begin(), parameters_.end(),
                       [&](const Parameter& one) { return path_of(one, preset_) == known.path; });
  };
  for (const OverlaidNumber& known : robot_.overlay)
    if (!is_ours(known)) out.push_back(known);
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (values[i] != parameters_[i].file)
      out.push_back({path_of(parameters_[i], preset_), parameters_[i].unit, parameters_[i].file, values[i]});
  return out;
}

std::string parameter_table(const std::vector<Parameter>& parameters, const std::vector<double>& values,
                            bool changed_only) {
  std::string out;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& one = parameters[i];
    const bool changed = values[i] != one.file;
    if (changed_only && !changed) continue;
    out += padded(one.name, 38) + padded(number_text(values[i]) + " " + one.unit, 16) +
           padded(number_text(one.least, 4) + " to " + number_text(one.most, 4), 18) +
           (changed ? "robot.yaml: " + number_text(one.file) + ". " : "") + one.meaning + "\n";
  }
  return out;
}

}  // namespace sprung
