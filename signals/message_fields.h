#pragma once
/// How one field of a signal becomes a field of its message, and back. Each pair of structs lists its fields
/// once, for both ways, so that the two cannot differ. For signals/messages*.cpp only.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "signals/message_mac.h"
#include "signals/modes.h"
#include "signals/reading.h"
#include "signals/stamp.h"

namespace sprung::fields {

/// Signal to message.
struct ToMessage {
  template <class T, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, bool>, int> = 0>
  void operator()(T& message, const T& signal) {
    message = signal;
  }
  void operator()(std::int8_t& message, const bool& signal) { message = signal ? 1 : 0; }
  template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0>
  void operator()(std::int8_t& message, const E& signal) {
    message = static_cast<std::int8_t>(signal);
  }
  void operator()(std::string& message, const std::string& signal) { message = signal; }
  template <std::size_t N>
  void operator()(double (&message)[N], const std::array<double, N>& signal) {
    std::copy(signal.begin(), signal.end(), message);
  }
  template <std::size_t N>
  void operator()(std::int32_t (&message)[N], const std::array<std::int32_t, N>& signal) {
    std::copy(signal.begin(), signal.end(), message);
  }
  template <std::size_t N>
  void operator()(std::uint8_t (&message)[N], const std::array<char, N>& signal) {
    std::copy(signal.begin(), signal.end(), message);
  }
  template <class M, class S, class Fields>
  void elements(std::int32_t& count, std::vector<M>& message, const std::vector<S>& signal, Fields each) {
    count = static_cast<std::int32_t>(signal.size());
    message.resize(signal.size());
    for (std::size_t i = 0; i < signal.size(); ++i) each(*this, message[i], signal[i]);
  }
};

/// Message to signal; `reading` is not good after what this build does not know.
struct FromMessage {
  Reading reading;
  template <class T, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, bool>, int> = 0>
  void operator()(const T& message, T& signal) {
    signal = message;
  }
  void operator()(const std::int8_t& message, bool& signal) { signal = message != 0; }
  template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0>
  void operator()(const std::int8_t& message, E& signal) {
    if (!is_known<E>(message)) reading.refuse(message, static_cast<std::int64_t>(kWords<E>.back().value));
    signal = static_cast<E>(message);
  }
  void operator()(const std::string& message, std::string& signal) { signal = message; }
  template <std::size_t N>
  void operator()(const double (&message)[N], std::array<double, N>& signal) {
    std::copy(message, message + N, signal.begin());
  }
  template <std::size_t N>
  void operator()(const std::int32_t (&message)[N], std::array<std::int32_t, N>& signal) {
    std::copy(message, message + N, signal.begin());
  }
  template <std::size_t N>
  void operator()(const std::uint8_t (&message)[N], std::array<char, N>& signal) {
    std::copy(message, message + N, signal.begin());
    signal.back() = '\0';
  }
  template <class M, class S, class Fields>
  void elements(const std::int32_t& count, const std::vector<M>& message, std::vector<S>& signal,
                Fields each) {
    if (count < 0 || static_cast<std::size_t>(count) != message.size())
      reading.refuse(count, static_cast<std::int64_t>(message.size()));
    if (!reading) return;
    signal.resize(message.size());
    for (std::size_t i = 0; i < message.size(); ++i) each(*this, message[i], signal[i]);
  }
};

template <class Way, class M, class S>
void stamp(Way& way, M& message, S& signal) {
  way(message.utime, signal.stamp.utime_us);
  way(message.seq, signal.stamp.seq);
}

/// The two ways, given a list of fields: a callable (way, message, signal).
template <class Fields, class S, class M>
void write(const Fields& list, const S& in, std::int64_t session, M& out) {
  ToMessage way;
  out.session = session;
  list(way, out, in);
  clear_mac(out);
}

/// 36,000 years in us: whoever adds or subtracts two such times or cycles does not overflow.
inline constexpr std::int64_t kFarthestStamp = std::int64_t{1} << 60U;

inline bool within_reach(std::int64_t stamp) noexcept {
  return stamp > -kFarthestStamp && stamp < kFarthestStamp;
}

template <class Fields, class M, class S>
Reading read(const Fields& list, const M& in, S& out) {
  FromMessage way;
  list(way, in, out);
  for (const std::int64_t stamp : {in.utime, in.seq}) {
    if (!within_reach(stamp)) way.reading.refuse(stamp, kFarthestStamp);
  }
  return way.reading;
}

}  // namespace sprung::fields
