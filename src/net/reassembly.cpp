#include "net/reassembly.hpp"

#include <algorithm>

namespace iog::net {
namespace {

constexpr std::uint32_t kUnitBytes = 8;

bool is_of(const Ipv4Packet& piece, const Ipv4Packet& name) {
  return piece.source == name.source && piece.destination == name.destination &&
         piece.protocol == name.protocol && piece.identification == name.identification;
}

}  // namespace

void Reassembly::expire(std::uint64_t now_us, FragmentCounters& counters) {
  for (Joining& joining : joinings_) {
    if (joining.is_open && now_us - joining.first_us > kTimeoutUs) {
      joining.is_open = false;
      counters.expired += joining.is_refused ? 0U : 1U;
    }
  }
}

// The place where the piece's datagram is, or begins.
Reassembly::Joining& Reassembly::joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                            FragmentCounters& counters) {
  Joining* place = joinings_.data();
  for (Joining& joining : joinings_) {
    if (joining.is_open && is_of(piece, joining.name)) {
      return joining;
    }
    if (place->is_open && (!joining.is_open || joining.first_us < place->first_us)) {
      place = &joining;
    }
  }
  if (place->is_open && !place->is_refused) {
    ++counters.displaced;
  }
  place->is_open = true;
  place->is_refused = false;
  place->name = piece;
  place->name.payload = {};
  place->first_us = now_us;
  place->total_bytes = 0;
  place->joined_bytes = 0;
  place->pieces = 0;
  return *place;
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
  Joining& joining = joining_of(piece, now_us, counters);
  if (joining.is_refused) {
    ++counters.refused;
    return {};
  }
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
  joining.is_open = false;
  ++counters.completed;
  Ipv4Packet whole = joining.name;
  whole.fragment_offset = 0;
  whole.has_more_fragments = false;
  whole.payload = std::span(joining.bytes).first(joining.total_bytes);
  return {.fate = Fate::kCompleted, .packet = whole, .pieces = joining.pieces};
}

}  // namespace iog::net
