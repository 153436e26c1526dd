#include "tools/logs/log/field_selection.h"

#include <algorithm>
#include <utility>

namespace sprung::log {

namespace {

constexpr std::size_t kShapesKept = 64;  // a channel with more counts than that has its fields chosen anew

/// Where the channel ends; a regular expression in slashes may hold dots.
std::size_t channel_end(const std::string& text) {
  const std::size_t from = text.empty() || text.front() != '/' ? 0 : text.find('/', 1);
  return from == std::string::npos ? std::string::npos : text.find('.', from);
}

}  // namespace

FieldSelection::FieldSelection(const std::vector<std::string>& texts, std::vector<fields::ListNames> names)
    : names_(std::move(names)) {
  for (const std::string& text : texts.empty() ? std::vector<std::string>{"*"} : texts) {
    const std::size_t end = channel_end(text);
    wishes_.push_back(
        {text, ChannelPattern(text.substr(0, end)), end == std::string::npos ? "*" : text.substr(end + 1)});
  }
}

const std::vector<std::string>& FieldSelection::patterns_of(std::string_view channel) {
  const auto found = by_channel_.find(channel);
  if (found != by_channel_.end()) return found->second;
  std::vector<std::string> patterns;
  for (const Wish& wish : wishes_) {
    if (wish.channel.matches(channel)) patterns.push_back(wish.path);
  }
  return by_channel_.emplace(channel, std::move(patterns)).first->second;
}

std::vector<const fields::Field*> FieldSelection::choose(std::string_view channel,
                                                         const fields::Layout& layout) {
  const std::vector<std::string>& patterns = patterns_of(channel);
  if (patterns.empty()) return {};
  note_matches(channel, layout);
  return fields::choose(layout, patterns, names_);
}

void FieldSelection::note_matches(std::string_view channel, const fields::Layout& layout) {
  for (Wish& wish : wishes_) {
    if (wish.matched || !wish.channel.matches(channel)) continue;
    wish.matched = std::any_of(layout.fields.begin(), layout.fields.end(), [&](const fields::Field& field) {
      return fields::matches(wish.path, field.path, names_);
    });
  }
}

std::vector<std::string> FieldSelection::unmatched() const {
  std::vector<std::string> texts;
  for (const Wish& wish : wishes_) {
    if (!wish.matched) texts.push_back(wish.text);
  }
  return texts;
}

const std::vector<ChosenFields::Chosen>& ChosenFields::of(const fields::MessageView& message,
                                                          std::string_view channel,
                                                          FieldSelection& selection) {
  const fields::Layout* const layout = message.layout();
  if (layout == last_layout_) return last_->fields;
  auto found = shapes_.find(layout);
  if (found == shapes_.end()) {
    if (shapes_.size() >= kShapesKept) shapes_.clear();
    found = shapes_.emplace(layout, make_shape(message, channel, selection)).first;
  }
  last_layout_ = layout;
  last_ = &found->second;
  return last_->fields;
}

void ChosenFields::fix_columns() noexcept {
  fixed_ = true;
  shapes_.clear();
  last_layout_ = nullptr;
}

ChosenFields::Shape ChosenFields::make_shape(const fields::MessageView& message, std::string_view channel,
                                             FieldSelection& selection) {
  Shape shape{message.keep_layout(), {}};
  for (const fields::Field* field : selection.choose(channel, *shape.layout)) {
    auto column = column_of_.find(field->path);
    if (column == column_of_.end()) {
      if (fixed_) continue;
      column = column_of_.emplace(field->path, columns_.size()).first;
      columns_.push_back({field->path, field->unit});
    }
    shape.fields.push_back({field, column->second});
  }
  return shape;
}

}  // namespace sprung::log
