#include "net/reassembly.hpp"

#include <algorithm>
#include <utility>

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
  if (address == Ipv4Address{}) {
    others_.datagrams += datagrams;
    return;
  }
  datagrams_ += datagrams;
  require(datagrams_ <= kMostDatagrams);
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
  for (const Joining& joining : joinings_) {
    if (is_open(joining) && now_us - joining.first_us > kTimeoutUs) {
      open_ &= ~bit_of(joining);
      counters.expired += joining.is_refused ? 0U : 1U;
    }
  }
}

// Chooses among the sender's own datagrams, or among those of all unlisted senders.
Reassembly::Joining& Reassembly::displaced_by(Ipv4Address sender, bool is_its_own) {
  Joining* least = nullptr;
  std::ptrdiff_t most = 0;
  std::pair<std::size_t, std::uint64_t> least_rank;
  for (Joining& joining : joinings_) {
    const Ipv4Address its_sender = joining.name.source;
    if (!is_open(joining) || (is_its_own ? its_sender != sender : senders_.is_listed(its_sender))) {
      continue;
    }
    const std::ptrdiff_t its = std::ranges::count_if(joinings_, [&](const Joining& other) {
      return is_open(other) && other.name.source == its_sender;
    });
    const std::pair rank(is_its_own ? 0 : joining.pieces, joining.first_us);
    if (its > most || (its == most && rank < least_rank)) {
      least = &joining;
      most = its;
      least_rank = rank;
    }
  }
  require(least != nullptr);
  return *least;
}

// Finds the slot of the fragment's datagram, or opens one.
Reassembly::Joining* Reassembly::joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                            FragmentCounters& counters) {
  const std::size_t allowed = senders_.datagrams_of(piece.source);
  if (allowed == 0) {
    return nullptr;
  }
  Joining* place = nullptr;
  std::size_t own = 0;
  std::size_t others = 0;
  for (Joining& joining : joinings_) {
    if (!is_open(joining)) {
      place = &joining;
      continue;
    }
    if (is_of(piece, joining.name)) {
      return &joining;
    }
    own += joining.name.source == piece.source ? 1U : 0U;
    others += senders_.is_listed(joining.name.source) ? 0U : 1U;
  }
  const bool is_full = !senders_.is_listed(piece.source) && others >= senders_.room_for_others();
  if (own >= allowed || is_full) {
    place = &displaced_by(piece.source, own >= allowed);
    counters.displaced += place->is_refused ? 0U : 1U;
  }
  require(place != nullptr);
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

// Every fragment but the last has a length that is a multiple of 8, none exceeds the end, and the
// end is unique.
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
