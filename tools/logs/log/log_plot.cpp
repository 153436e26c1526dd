#include "tools/logs/log/log_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "tools/logs/fields/value_text.h"
#include "tools/logs/log/field_hint.h"
#include "tools/logs/log/thin_series.h"

namespace sprung::log {

namespace {

constexpr std::size_t kMostCurves = 60;
constexpr std::size_t kMostShades = 400;

/// The curves of one channel.
struct ChannelCurves {
  ChosenFields fields;
  std::vector<ThinSeries> series;  ///< by column
};

/// Stretches in which a field has one value.
class Phases {
 public:
  /// @param field "" = none: no channel has an empty name.
  Phases(const std::string& field, const std::vector<fields::ListNames>& names)
      : selection_({field}, names) {}

  bool wants(std::string_view channel) { return selection_.wants(channel); }
  void add(double time_s, const fields::MessageView& message, std::string_view channel) {
    const auto& chosen = fields_.of(message, channel, selection_);
    if (chosen.empty()) return;
    const fields::Field& field = *chosen.front().field;
    const char* const name = message.enumeration(field);
    std::string now = name != nullptr ? name : fields::value_text(message, field);
    if (full_) return;
    const bool same = !shades_.empty() && shades_.back().name == now;
    if (!shades_.empty()) shades_.back().to = time_s;
    if (same) return;
    full_ = shades_.size() == kMostShades;
    if (!full_) shades_.push_back({time_s, time_s, std::move(now)});
  }
  /// How the shades end before the curves do, or "".
  std::string note() const {
    if (!full_) return "";
    char text[80];
    std::snprintf(text, sizeof text, "phases are shaded up to %.3f s: choose a span", shades_.back().to);
    return text;
  }
  bool is_missing() const { return !selection_.unmatched().empty(); }
  const std::vector<report::Shade>& shades() const noexcept { return shades_; }

 private:
  FieldSelection selection_;
  ChosenFields fields_;
  std::vector<report::Shade> shades_;
  bool full_ = false;  ///< there was another after the last one that is kept
};

class Collector {
 public:
  explicit Collector(const PlotRequest& request)
      : selection_(request.fields, request.names),
        phases_(request.phases, request.names),
        phases_text_(request.phases),
        phases_asked_(!request.phases.empty() && request.phases != PlotRequest().phases),
        names_(request.joint_names) {}

  void add(const Event& event, double time_s) {
    const bool drawn = selection_.wants(event.channel);
    if (!drawn && !phases_.wants(event.channel)) return;
    if (decoder_.open(event.data, event.size, message_) != fields::Fault::kNone) return;
    if (phases_.wants(event.channel)) phases_.add(time_s, message_, event.channel);
    if (drawn) add_samples(event, time_s);
  }

  std::vector<report::Plot> plots() const;
  std::vector<std::string> unmatched() const {
    std::vector<std::string> texts = selection_.unmatched();
    if (phases_asked_ && phases_.is_missing()) texts.push_back(phases_text_);
    return texts;
  }
  std::string note() const { return phases_.note(); }

 private:
  void add_samples(const Event& event, double time_s) {
    ChannelCurves& curves = channels_[std::string(event.channel)];
    for (const ChosenFields::Chosen& chosen : curves.fields.of(message_, event.channel, selection_)) {
      if (chosen.field->kind == fields::Kind::kText || chosen.field->kind == fields::Kind::kBytes) continue;
      if (curves.series.size() <= chosen.column) curves.series.resize(chosen.column + 1);
      curves.series[chosen.column].add(time_s, message_.number(*chosen.field));
    }
    if (curves.series.size() > kMostCurves) refuse();
  }
  [[noreturn]] static void refuse() {
    throw std::invalid_argument(
        "that is more than " + std::to_string(kMostCurves) +
        " curves: choose fewer fields, e.g. JOINT_STATE.joints[*].gear_output_torque_Nm");
  }
  std::string curve_name(const std::string& channel, const std::string& path) const {
    return channel + "." + (names_ ? fields::with_names(path, selection_.names()) : path);
  }

  FieldSelection selection_;
  Phases phases_;
  std::string phases_text_;
  bool phases_asked_;  ///< not all logs have the ones that are taken unless asked otherwise
  bool names_;
  fields::Decoder decoder_;
  fields::MessageView message_;
  std::map<std::string, ChannelCurves, std::less<>> channels_;
};

std::vector<report::Plot> Collector::plots() const {
  std::vector<report::Plot> plots;
  std::size_t curves = 0;
  for (const auto& [channel, one] : channels_) {
    for (std::size_t i = 0; i < one.series.size(); ++i) {
      if (one.series[i].empty()) continue;
      if (++curves > kMostCurves) refuse();
      const ChosenFields::Column& column = one.fields.columns()[i];
      auto plot = std::find_if(plots.begin(), plots.end(),
                               [&](const report::Plot& other) { return other.y.unit == column.unit; });
      if (plot == plots.end()) {
        plots.push_back({"", {"time", "s"}, {column.unit.empty() ? "value" : "", column.unit}});
        plot = plots.end() - 1;
        plot->shades = phases_.shades();
      }
      plot->series.push_back({curve_name(channel, column.path), one.series[i].x(), one.series[i].y()});
    }
  }
  return plots;
}

/// How many letters all names begin with, up to a dot or a bracket.
std::size_t common_begin(const std::vector<report::Series>& series) {
  const std::string& first = series.front().name;
  std::size_t same = first.size();
  for (const report::Series& one : series) {
    const auto end = std::mismatch(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(same),
                                   one.name.begin(), one.name.end());
    same = static_cast<std::size_t>(end.first - first.begin());
  }
  const std::size_t cut = first.find_last_of(".[", same == 0 ? 0 : same - 1);
  return same == 0 || cut == std::string::npos ? 0 : cut + 1;
}

/// How many letters all names end with, from a dot or a bracket on.
std::size_t common_end(const std::vector<report::Series>& series) {
  std::vector<report::Series> reversed = series;
  for (report::Series& one : reversed) std::reverse(one.name.begin(), one.name.end());
  const std::string& first = reversed.front().name;
  std::size_t same = first.size();
  for (const report::Series& one : reversed) {
    const auto end = std::mismatch(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(same),
                                   one.name.begin(), one.name.end());
    same = static_cast<std::size_t>(end.first - first.begin());
  }
  const std::size_t cut = first.find_last_of(".]", same == 0 ? 0 : same - 1);
  return same == 0 || cut == std::string::npos ? 0 : cut + 1;
}

/// "JOINT_STATE.joints[hip].torque_Nm" and "...[knee]..." become "hip" and "knee" under
/// "JOINT_STATE.joints[...].torque_Nm".
void shorten_names(report::Plot& plot) {
  if (plot.series.size() < 2) {
    plot.title = plot.series.front().name;
    return;
  }
  const std::size_t begin = common_begin(plot.series);
  std::size_t end = common_end(plot.series);
  const auto too_short = [&](const report::Series& one) { return one.name.size() <= begin + end; };
  if (std::any_of(plot.series.begin(), plot.series.end(), too_short)) end = 0;
  if (begin + end == 0) return;
  const std::string first = plot.series.front().name;
  plot.title = end == 0 ? first.substr(0, begin - 1)
                        : first.substr(0, begin) + "..." + first.substr(first.size() - end);
  for (report::Series& one : plot.series) one.name = one.name.substr(begin, one.name.size() - begin - end);
}

std::string subtitle_of(Reader& reader) {
  const auto metadata = find_metadata(reader);
  if (!metadata) return "";
  return metadata->robot + ", preset " + metadata->preset + ", sprung " + metadata->version + " (" +
         metadata->git_hash + ")";
}

}  // namespace

LogPlot collect_plot(Reader& reader, const PlotRequest& request, const Progress& progress) {
  LogPlot plot;
  plot.title = reader.path();
  plot.subtitle = subtitle_of(reader);
  Collector collector(request);
  const SpanTest span(request.span, request.span.needs_end() ? extent_of(reader) : LogExtent{});
  Timeline timeline;
  std::int64_t events = 0;
  for (Event event; reader.next(event);) {
    const double time_s = timeline.next(event).time_s;
    if (span.holds(time_s, event.time_us)) collector.add(event, time_s);
    if (progress && ++events % kEventsBetween == 0) progress(reader.position(), reader.file_bytes());
  }
  plot.plots = collector.plots();
  plot.unmatched = collector.unmatched();
  if (const std::string note = collector.note(); !note.empty())
    plot.subtitle += (plot.subtitle.empty() ? "" : "; ") + note;
  for (report::Plot& one : plot.plots) shorten_names(one);
  if (plot.plots.empty())
    throw std::invalid_argument(plot.unmatched.empty()
                                    ? "there is no number to draw: only texts, or nothing in that time"
                                    : no_field_text(reader.path(), plot.unmatched.front()));
  return plot;
}

report::Report plot_report(const LogPlot& plot, const std::string& command) {
  report::Report report{plot.title, plot.subtitle, command, {}};
  report::Section section;
  section.plots = plot.plots;
  report.sections.push_back(std::move(section));
  return report;
}

}  // namespace sprung::log
