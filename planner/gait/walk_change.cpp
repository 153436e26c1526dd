/// From one gait to the next, and to rest.
#include <algorithm>

#include "planner/gait/walk.h"
#include "robots/gait_speed.h"

namespace sprung {
namespace {

/// [design choice] A walk that is to end rests after this: its operator may be gone.
constexpr double kStop_s = 0.6;

}  // namespace

void Walk::change(const WalkRequest& request) noexcept {
  request_ = request;
  stopping_ = halting_ = false;
  placing_ = false;
  weight_.move();
  ramp_.want(request.speed);
  wanted_ = order_of(request);
  clock_.resume();
  hold_for_next();
}

/// Its legs follow each other differently backward.
bool Walk::has_a_way(std::size_t gait) const noexcept {
  return backward_gaits_[gait].offsets != gaits_[gait].offsets;
}

/// The legs of the gait that is to come follow each other for its own speeds, and for the way that it goes:
/// until the body goes no faster, and not the other way, the present gait goes on.
bool Walk::slow_enough() const noexcept {
  constexpr double kOtherWay_m_s = 0.02;
  const auto place = static_cast<std::size_t>(wanted_.gait);
  const double forward_m_s = ramp_.now()[0];
  const bool its_way = !has_a_way(place) || (wanted_.backward ? -forward_m_s : forward_m_s) > -kOtherWay_m_s;
  return its_way && speed_share(gaits_[place], ramp_.now()) <= kMostSpeedShare;
}

/// It begins when all feet stand.
void Walk::hold_for_next() noexcept {
  if (!(wanted_ == now_) && !stopping_ && !comes_to_rest() && slow_enough()) clock_.hold();
}

void Walk::stop() noexcept {
  stopping_ = true;
  ramp_.stop(kStop_s);
  if (!ended_ && failure_ == nullptr) place_feet();
  if (wanted_ == now_ || failure_ != nullptr || ended_) return;
  wanted_ = now_;  // not the gait that was to come: this one sets the feet in their places
  clock_.resume();
}

void Walk::halt() noexcept {
  stop();
  if (halting_) return;
  halting_ = true;
  halt_left_s_ = kHalt_s;
}

/// Turning or sideways alone it keeps the order that it has.
GaitOrder Walk::order_of(const WalkRequest& request) const noexcept {
  const auto place = static_cast<std::size_t>(request.gait);
  const double forward_m_s = request.speed[0];
  const bool backward = forward_m_s < 0.0 || (forward_m_s == 0.0 && wanted_.backward);
  return {request.gait, has_a_way(place) && backward};
}

/// To a gait that never swings: the one that does slows down first, and sets each foot in its place once
/// more.
bool Walk::comes_to_rest() const noexcept { return gait().duty < 1.0 && gaits_[wanted_.gait].duty >= 1.0; }

void Walk::place_feet() noexcept {
  if (placing_ || gait().duty >= 1.0) return;
  clock_.count_anew();
  placing_ = true;
}

bool Walk::rests() const noexcept { return weight_.upright() || (halting_ && weight_.rests()); }

void Walk::next_gait() noexcept {
  const bool all_stand = clock_.all_stand();
  hold_for_next();
  if (comes_to_rest() && ramp_.arrived()) place_feet();
  if (placing_ && clock_.rounds() > 0) clock_.hold();
  const bool settled = std::all_of(
      steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(shape_.legs),
      [&](const LegStep& s) { return s.stands() && s.in_phase_s() >= law_.force_rise_s; });
  const bool placed = placing_ && clock_.rounds() > 0;
  const bool done = gait().duty >= 1.0 || failure_ != nullptr || placed || (halting_ && clock_.holds());
  if (stopping_ && ramp_.arrived() && settled && all_stand && done && rests()) ended_ = true;
  const bool ready = comes_to_rest() ? placed : settled && slow_enough();
  if (!stopping_ && all_stand && ready && !(wanted_ == now_)) {
    now_ = wanted_;
    placing_ = false;
    start_clock();
  }
}

}  // namespace sprung
