#pragma once
/// Fields of a log as people name them: "JOINT_STATE.joints[2].gear_output_torque_Nm", with stars in channel
/// and path, with joints by name
/// ("joints[knee]"), or a channel alone for all its fields. Pure.
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/fields/field_choice.h"
#include "tools/logs/log/channel_filter.h"

namespace sprung::log {

class FieldSelection {
 public:
  /// @param texts empty: every field of every channel. @throws std::invalid_argument on a channel pattern
  /// that is none.
  explicit FieldSelection(const std::vector<std::string>& texts, std::vector<fields::ListNames> names = {});

  bool wants(std::string_view channel) { return !patterns_of(channel).empty(); }
  /// Of the channel, as they are encoded.
  std::vector<const fields::Field*> choose(std::string_view channel, const fields::Layout& layout);
  const std::vector<fields::ListNames>& names() const noexcept { return names_; }
  /// Texts that no field has matched so far: of a channel that is not there, or with a slip of the pen.
  std::vector<std::string> unmatched() const;

 private:
  struct Wish {
    std::string text;
    ChannelPattern channel;
    std::string path;  ///< pattern
    bool matched = false;
  };
  void note_matches(std::string_view channel, const fields::Layout& layout);
  const std::vector<std::string>& patterns_of(std::string_view channel);

  std::vector<Wish> wishes_;
  std::vector<fields::ListNames> names_;
  std::map<std::string, std::vector<std::string>, std::less<>> by_channel_;
};

/// The chosen fields of one channel's messages, each with a number that belongs to its path: the same in
/// every shape of the type.
class ChosenFields {
 public:
  struct Column {
    std::string path;
    std::string unit;
  };
  struct Chosen {
    const fields::Field* field = nullptr;
    std::size_t column = 0;
  };

  /// Of the message's shape; paths that are new get the next numbers unless columns are fixed: then they are
  /// left out.
  const std::vector<Chosen>& of(const fields::MessageView& message, std::string_view channel,
                                FieldSelection& selection);
  const std::vector<Column>& columns() const noexcept { return columns_; }
  void fix_columns() noexcept;

 private:
  struct Shape {
    std::shared_ptr<const fields::Layout> layout;  ///< kept, so that no other gets its address
    std::vector<Chosen> fields;
  };
  Shape make_shape(const fields::MessageView& message, std::string_view channel, FieldSelection& selection);

  std::vector<Column> columns_;
  std::unordered_map<std::string, std::size_t> column_of_;  ///< by path
  std::unordered_map<const fields::Layout*, Shape> shapes_;
  const fields::Layout* last_layout_ = nullptr;
  const Shape* last_ = nullptr;
  bool fixed_ = false;
};

}  // namespace sprung::log
