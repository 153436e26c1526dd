#include "runtime/transport/fragment_store.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace sprung {

void FragmentStore::forget(std::size_t index) {
  open_bytes_ -= open_[index].message.bytes.size();
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(index));
  ++forgotten_;
}

void FragmentStore::forget_old(std::int64_t now_us) {
  for (std::size_t i = open_.size(); i-- > 0;) {
    if (now_us - open_[i].touched_us > kPatience_us) forget(i);
  }
}

void FragmentStore::make_room(std::size_t bytes) {
  const auto earlier = [](const Open& a, const Open& b) { return a.touched_us < b.touched_us; };
  while (open_.size() >= kMostMessages || open_bytes_ + bytes > kMostBytes) {
    const auto oldest = std::min_element(open_.begin(), open_.end(), earlier);
    forget(static_cast<std::size_t>(oldest - open_.begin()));
  }
}

FragmentStore::Open& FragmentStore::open_for(const DatagramSender& sender, const LcmPacket& packet,
                                             std::int64_t now_us) {
  const auto same = [&](const Open& one) { return one.sender == sender && one.seq == packet.seq; };
  const auto found = std::find_if(open_.begin(), open_.end(), same);
  if (found != open_.end()) return *found;
  make_room(packet.message_size);
  open_bytes_ += packet.message_size;
  Open begun;
  begun.sender = sender;
  begun.seq = packet.seq;
  begun.touched_us = now_us;
  begun.there.resize(packet.count);
  begun.message.bytes.resize(packet.message_size);
  open_.push_back(std::move(begun));
  return open_.back();
}

const FragmentStore::Message* FragmentStore::add(const DatagramSender& sender, const LcmPacket& packet,
                                                 std::int64_t now_us) {
  forget_old(now_us);
  if (packet.message_size > kLargestMessage) return ++refused_, nullptr;
  Open& one = open_for(sender, packet, now_us);
  const bool agrees = one.message.bytes.size() == packet.message_size && one.there.size() == packet.count;
  if (!agrees || one.there[packet.number]) return ++refused_, nullptr;
  one.touched_us = now_us;
  one.there[packet.number] = true;
  one.bytes_there += packet.size;
  ++one.pieces_there;
  std::memcpy(one.message.bytes.data() + packet.offset, packet.data, packet.size);
  if (packet.number == 0) one.message.channel = packet.channel;
  if (one.pieces_there < one.there.size()) return nullptr;
  // Pieces that overlap leave a gap elsewhere.
  const bool whole = one.bytes_there == one.message.bytes.size();
  open_bytes_ -= one.message.bytes.size();
  whole_ = std::move(one.message);
  open_.erase(open_.begin() + (&one - open_.data()));
  return whole ? &whole_ : (++refused_, nullptr);
}

}  // namespace sprung
