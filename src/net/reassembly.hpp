// Reassembles fragmented UDP datagrams (RFC 791, section 3.2) in bounded memory.
//
// Some lidars send packets that do not fit into one frame, so they arrive as fragments. Source,
// destination, protocol and identification identify a datagram. It is complete when its fragments,
// which must not overlap, cover the length given by the last fragment. A fragment that contradicts
// another one invalidates its datagram, and all further fragments of that datagram are dropped (RFC
// 5722, section 4). A fragment that repeats another one byte for byte is a harmless duplicate.
//
// Only fragments of listed senders are stored. Each listed sender may have as many incomplete
// datagrams as it has streams, and their slots are reserved. A sender that starts too many loses
// its own oldest. If unlisted senders are allowed, they share the remaining slots. When those are
// full, the address with the most datagrams loses the one with the fewest fragments, the oldest of
// these if several are equal. A flood of orphaned fragments is therefore evicted before a sensor's
// datagram.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "net/counters.hpp"
#include "net/ipv4.hpp"

namespace iog::net {

// The senders whose fragments are stored: at most kMostSenders addresses with kMostDatagrams in
// total.
class FragmentSenders {
 public:
  // A car has eight sensors, each sending one datagram at a time, a pose source, a map source, and
  // one replayer of all eight sensors.
  static constexpr std::size_t kMostDatagrams = 8 + 2 + 8;
  static constexpr std::size_t kMostSenders = 8 + 2 + 1;

  // Allows this sender `datagrams` more incomplete datagrams at a time. 0.0.0.0 stands for each
  // unlisted sender; these use the slots that the listed ones leave.
  void add(Ipv4Address address, std::size_t datagrams = 1);

  // The allowed number of incomplete datagrams (0: none), and whether slots are reserved for them.
  [[nodiscard]] std::size_t datagrams_of(Ipv4Address address) const {
    return of(address).datagrams;
  }
  [[nodiscard]] bool is_listed(Ipv4Address address) const { return of(address).address == address; }
  [[nodiscard]] std::size_t room_for_others() const { return kMostDatagrams - datagrams_; }

 private:
  struct Sender {
    Ipv4Address address;
    std::size_t datagrams = 0;
  };

  [[nodiscard]] Sender of(Ipv4Address address) const;

  Sender others_{};
  std::array<Sender, kMostSenders> senders_{};
  std::size_t count_ = 0;
  std::size_t datagrams_ = 0;  // sum over the listed senders
};

// 642 KB: 35.7 KB for each datagram.
class Reassembly {
 public:
  static constexpr std::size_t kDatagrams = FragmentSenders::kMostDatagrams;
  // The UDP header and the longest payload of a sensor: 35,336 bytes from a Continental ARS548. An
  // Ouster with 128 rows and two returns sends 33,024 bytes.
  static constexpr std::size_t kMaxBytes = 35'336 + 8;
  // 35,344 bytes take 24 fragments of 1480 bytes. No sender uses fragments below 984 bytes.
  static constexpr std::size_t kMaxPieces = 36;
  // Counted from the first fragment received. At 100 Mbit/s the fragments of a datagram arrive
  // within 3 ms. At 1,280 datagrams a second a lidar's identification repeats after 51 s.
  static constexpr std::uint64_t kTimeoutUs = 100'000;

  enum class Fate : std::uint8_t {
    kJoined,     // stored; the datagram is incomplete
    kCompleted,  // `packet` is the whole datagram
    kDropped,
  };
  struct [[nodiscard]] Result {
    Fate fate = Fate::kDropped;
    // Meaningful only with kCompleted. The payload is valid until the next add(). `pieces` is the
    // number of fragments.
    Ipv4Packet packet{};
    std::size_t pieces = 0;
  };

  explicit Reassembly(const FragmentSenders& senders) : senders_(senders) {}
  // Accepts every sender, for reading captures.
  Reassembly() { senders_.add({}, kDatagrams); }

  // `piece` is a packet with Ipv4Status::kFragment. now_us never decreases. Each call increments
  // one of joined, completed, duplicates, overlaps, bad and refused, and also counts displaced and
  // expired datagrams.
  Result add(const Ipv4Packet& piece, std::uint64_t now_us, FragmentCounters& counters);

 private:
  struct Extent {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  struct Joining {
    bool is_refused = false;  // the datagram's key is kept until it expires
    Ipv4Packet name;
    std::uint64_t first_us = 0;
    std::uint32_t total_bytes = 0;  // 0: the last fragment has not arrived
    std::uint32_t joined_bytes = 0;
    std::size_t pieces = 0;
    std::array<Extent, kMaxPieces> extents{};  // of the fragments, disjoint, in order of arrival
    std::array<std::byte, kMaxBytes> bytes{};
  };

  void expire(std::uint64_t now_us, FragmentCounters& counters);
  // Null if the sender may not send fragments.
  [[nodiscard]] Joining* joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                    FragmentCounters& counters);
  [[nodiscard]] Joining& displaced_by(Ipv4Address sender, bool is_its_own);
  [[nodiscard]] static bool is_possible(const Joining& joining, const Extent& extent,
                                        bool has_more);

  // The open flags are kept apart so that scans skip the memory of unused slots.
  [[nodiscard]] std::uint32_t bit_of(const Joining& joining) const {
    return std::uint32_t{1} << (&joining - joinings_.data());
  }
  [[nodiscard]] bool is_open(const Joining& joining) const {
    return (open_ & bit_of(joining)) != 0;
  }

  FragmentSenders senders_;
  std::uint32_t open_ = 0;
  static_assert(kDatagrams <= 32);
  std::array<Joining, kDatagrams> joinings_{};
};

}  // namespace iog::net
