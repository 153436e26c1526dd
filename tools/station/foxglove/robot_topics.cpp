#include "tools/station/foxglove/robot_topics.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/station/foxglove/robot_messages.h"
#include "tools/station/frames/version_notes.h"

namespace sprung::station {

namespace {

constexpr double kMost_Hz = 100.0;

class RobotTopics : public log::McapAdditions {
 public:
  RobotTopics(const RobotConfig& robot, const nlohmann::json& scene, std::string model_xml)
      : model_xml_(std::move(model_xml)), frames_(robot), messages_(robot, scene, frames_.fields()) {}

  void begin(log::McapWriter& writer) override {
    std::map<std::string, std::uint16_t> schemas;
    for (const RobotTopic topic : kRobotTopics) {
      const std::string type = type_of(topic);
      if (schemas.count(type) == 0)
        schemas[type] = writer.add_schema(type, "protobuf", foxglove_schema(type));
      channels_.push_back({topic, writer.add_channel(schemas[type], name_of(topic), "protobuf"), 0});
    }
    if (!model_xml_.empty()) writer.add_attachment(0, "model.xml", "application/xml", model_xml_);
  }
  std::vector<log::McapAddition> add(const log::Event& event, double time_s, std::int64_t begin_us) override {
    begin_us_ = begin_us;
    return messages_of(frames_.add(event.channel, event.data, event.size, time_s));
  }
  std::vector<log::McapAddition> finish() override { return messages_of(frames_.finish()); }
  std::vector<std::string> notes(const std::string& maker) const override {
    std::vector<std::string> notes = version_notes(frames_, maker);
    if (!posed_) notes.push_back(no_pose(frames_, maker));
    return notes;
  }

 private:
  struct Channel {
    RobotTopic topic;
    std::uint16_t id = 0;
    std::uint32_t sequence = 0;
  };

  std::vector<log::McapAddition> messages_of(const Frame* frame) {
    if (frame == nullptr || frame->time_s < next_s_ || !frames_.has_pose(*frame)) return {};
    posed_ = true;
    next_s_ = frame->time_s + 1.0 / kMost_Hz;
    const auto time_ns = static_cast<std::uint64_t>(
                             std::llround(static_cast<double>(begin_us_) + 1e6 * frame->time_s)) *
                         1000;
    std::vector<log::McapAddition> out;
    for (Channel& channel : channels_) {
      if (channel.topic == RobotTopic::kShapes && channel.sequence > 0) continue;
      std::string data = messages_.message(channel.topic, *frame, time_ns);
      if (!data.empty()) out.push_back({{channel.id, channel.sequence++, time_ns, time_ns}, std::move(data)});
    }
    return out;
  }

  std::string model_xml_;
  Frames frames_;
  RobotMessages messages_;
  std::vector<Channel> channels_;
  std::int64_t begin_us_ = 0;
  bool posed_ = false;  ///< a frame has had a pose
  double next_s_ = 0.0;
};

}  // namespace

std::unique_ptr<log::McapAdditions> make_robot_topics(const RobotConfig& robot, const nlohmann::json& scene,
                                                      const std::string& model_xml) {
  return std::make_unique<RobotTopics>(robot, scene, model_xml);
}

}  // namespace sprung::station
