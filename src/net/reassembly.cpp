#include "net/reassembly.hpp"

#include <algorithm>

#include "require/require.hpp"

namespace iog::net {
namespace {

constexpr std::uint32_t kUnitBytes = 8;

bool is_of(const Ipv4Packet& piece, const Ipv4Packet& name) {
  return piece.source == name.source && piece.destination == name.destination &&
         piece.protocol == name.protocol && piece.identification == name.identification;
}

}  // namespace

void FragmentSenders::add(Ipv4Address address, std::size_t datagrams) {
  datagrams_ += datagrams;
  require(datagrams_ <= kMostDatagrams);
  if (address == Ipv4Address{}) {
    others_.datagrams += datagrams;
    return;
  }
  for (Sender& sender : std::span(senders_).first(count_)) {
    if (sender.address == address) {
      sender.datagrams += datagrams;
      return;
    }
  }
  require(count_ < senders_.size());
  senders_[count_++] = {address, datagrams};
}

FragmentSenders::Sender FragmentSenders::of(Ipv4Address address) const {
  for (const Sender& sender : std::span(senders_).first(count_)) {
    if (sender.address == address) {
      return sender;
    }
  }
  return others_;
}

void Reassembly::expire(std::uint64_t now_us, FragmentCounters& counters) {
  for (Joining& joining : joinings_) {
    if (is_open(joining) && now_us - joining.first_us > kTimeoutUs) {
      open_ &= ~bit_of(joining);
      counters.expired += joining.is_refused ? 0U : 1U;
    }
  }
}

// Of the datagrams that share room with the sender's: the oldest of the address that has most.
Reassembly::Joining& Reassembly::displaced_by(Ipv4Address sender) {
  Joining* least = nullptr;
  std::ptrdiff_t most = 0;
  for (Joining& joining : joinings_) {
    if (!is_open(joining) || !senders_.share(sender, joining.name.source)) {
      continue;
    }
    const std::ptrdiff_t its = std::ranges::count_if(joinings_, [&](const Joining& other) {
      return is_open(other) && other.name.source == joining.name.source;
    });
    if (its > most || (its == most && joining.first_us < least->first_us)) {
      least = &joining;
      most = its;
    }
  }
  require(least != nullptr);
  return *least;
}

// The place where the piece's datagram is, or begins.
Reassembly::Joining* Reassembly::joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                            FragmentCounters& counters) {
  const std::size_t allowed = senders_.datagrams_of(piece.source);
  if (allowed == 0) {
    return nullptr;
  }
  Joining* place = nullptr;
  std::size_t open = 0;
  for (Joining& joining : joinings_) {
    if (!is_open(joining)) {
      place = &joining;
    } else if (is_of(piece, joining.name)) {
      return &joining;
    } else if (senders_.share(piece.source, joining.name.source)) {
      ++open;
    }
  }
  if (open >= allowed || place == nullptr) {
    place = &displaced_by(piece.source);
    counters.displaced += place->is_refused ? 0U : 1U;
  }
  open_ |= bit_of(*place);
  place->is_refused = false;
  place->name = piece;
  place->name.payload = {};
  place->first_us = now_us;
  place->total_bytes = 0;
  place->joined_bytes = 0;
  place->pieces = 0;
  return place;
}

// All but the last piece are whole units, nothing lies behind the end, and there is one end only.
bool Reassembly::is_possible(const Joining& joining, const Extent& extent, bool has_more) {
  const std::uint32_t bytes = extent.end - extent.begin;
  if (bytes == 0 || extent.end > kMaxBytes || (has_more && bytes % kUnitBytes != 0)) {
    return false;
  }
  if (joining.total_bytes != 0) {
    return has_more ? extent.end < joining.total_bytes : extent.end == joining.total_bytes;
  }
  const auto known = std::span(joining.extents).first(joining.pieces);
  return has_more ||
         std::ranges::none_of(known, [&](const Extent& other) { return other.end > extent.end; });
}

Reassembly::Result Reassembly::add(const Ipv4Packet& piece, std::uint64_t now_us,
                                   FragmentCounters& counters) {
  expire(now_us, counters);
  Joining* const place_of_piece = joining_of(piece, now_us, counters);
  if (place_of_piece == nullptr || place_of_piece->is_refused) {
    ++counters.refused;
    return {};
  }
  Joining& joining = *place_of_piece;
  const Extent extent{piece.fragment_offset,
                      piece.fragment_offset + static_cast<std::uint32_t>(piece.payload.size())};
  if (!is_possible(joining, extent, piece.has_more_fragments)) {
    ++counters.bad;
    joining.is_refused = true;
    return {};
  }
  const auto place = std::span(joining.bytes).subspan(extent.begin, piece.payload.size());
  const auto known = std::span(joining.extents).first(joining.pieces);
  const auto meets = [&](const Extent& other) {
    return other.begin < extent.end && extent.begin < other.end;
  };
  const auto other = std::ranges::find_if(known, meets);
  if (other != known.end()) {
    const bool is_same = other->begin == extent.begin && other->end == extent.end &&
                         std::ranges::equal(piece.payload, place);
    ++(is_same ? counters.duplicates : counters.overlaps);
    joining.is_refused = !is_same;
    return {};
  }
  if (joining.pieces == kMaxPieces) {
    ++counters.bad;
    joining.is_refused = true;
    return {};
  }
  std::ranges::copy(piece.payload, place.begin());
  joining.extents[joining.pieces++] = extent;
  joining.joined_bytes += extent.end - extent.begin;
  joining.total_bytes = piece.has_more_fragments ? joining.total_bytes : extent.end;
  if (joining.joined_bytes != joining.total_bytes) {
    ++counters.joined;
    return {.fate = Fate::kJoined};
  }
  open_ &= ~bit_of(joining);
  ++counters.completed;
  Ipv4Packet whole = joining.name;
  whole.fragment_offset = 0;
  whole.has_more_fragments = false;
  whole.payload = std::span(joining.bytes).first(joining.total_bytes);
  return {.fate = Fate::kCompleted, .packet = whole, .pieces = joining.pieces};
}

}  // namespace iog::net
