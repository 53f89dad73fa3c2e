// Reassembles fragmented UDP datagrams (RFC 791, section 3.2) in bounded memory.
//
// Some lidars send packets that do not fit into one frame and therefore arrive as fragments. A
// datagram is identified by its source, destination, protocol and identification field. The
// fragments of a datagram must not overlap. A datagram is complete when its fragments cover it up
// to the end of the last fragment. If a fragment contradicts another fragment, the datagram is
// invalid. All further fragments of this datagram are dropped (RFC 5722, section 4). A fragment
// that repeats another fragment byte for byte is ignored as a duplicate.
//
// Only fragments from listed senders are stored. A listed sender may have one incomplete datagram
// for each stream that it sends. Slots are reserved for these datagrams. If a sender exceeds its
// limit, its oldest incomplete datagram is evicted. If unlisted senders are allowed, they share the
// remaining slots. If all shared slots are in use, a datagram of the unlisted sender with the most
// datagrams is evicted. The evicted datagram is the one with the fewest fragments or, in a tie, the
// oldest one. In a flood, orphaned fragments are therefore evicted before a sensor's datagrams.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "net/counters.hpp"
#include "net/ipv4.hpp"

namespace iog::net {

// The senders whose fragments are stored. The list can contain up to kMostSenders addresses, with
// up to kMostDatagrams incomplete datagrams in total.
class FragmentSenders {
 public:
  // A car has up to eight sensors, a pose source and a map source, each of which sends one datagram
  // at a time. One replayer can send the datagrams of all eight sensors.
  static constexpr std::size_t kMostDatagrams = 8 + 2 + 8;
  static constexpr std::size_t kMostSenders = 8 + 2 + 1;

  // Raises the sender's limit on incomplete datagrams by `datagrams`. The address 0.0.0.0 stands
  // for all unlisted senders. Unlisted senders use the slots that are not reserved for listed
  // senders.
  void add(Ipv4Address address, std::size_t datagrams = 1);

  // `datagrams_of()` returns how many incomplete datagrams a sender may have, or 0 if its fragments
  // are not accepted. `is_listed()` returns true if slots are reserved for the sender.
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
  std::size_t datagrams_ = 0;  // sum over all listed senders
};

// An object of this class takes up 642 KB (35.7 KB per datagram).
class Reassembly {
 public:
  static constexpr std::size_t kDatagrams = FragmentSenders::kMostDatagrams;
  // The longest payload of any sensor plus the UDP header. A Continental ARS548 has the longest
  // payload, 35,336 bytes. An Ouster with 128 rows and two returns sends 33,024 bytes per packet.
  static constexpr std::size_t kMaxBytes = 35'336 + 8;
  // A datagram of 35,344 bytes is split into 24 fragments of 1480 bytes. No sender uses fragments
  // shorter than 984 bytes.
  static constexpr std::size_t kMaxPieces = 36;
  // The timeout starts when the first fragment is received. At 100 Mbit/s, the fragments of a
  // datagram arrive within 3 ms. If a lidar sends 1,280 datagrams per second, their 16-bit
  // identification wraps around after 51 s.
  static constexpr std::uint64_t kTimeoutUs = 100'000;

  enum class Fate : std::uint8_t {
    kJoined,     // stored; the datagram is incomplete
    kCompleted,  // `packet` contains the whole datagram
    kDropped,
  };
  struct [[nodiscard]] Result {
    Fate fate = Fate::kDropped;
    // `packet` is valid only for kCompleted. The payload is valid until the next call to add().
    // `pieces` is the number of fragments.
    Ipv4Packet packet{};
    std::size_t pieces = 0;
  };

  explicit Reassembly(const FragmentSenders& senders) : senders_(senders) {}
  // This constructor is used to read captures. The object then accepts fragments from every sender.
  Reassembly() { senders_.add({}, kDatagrams); }

  // `piece` must be a packet for which parse_ipv4() returned Ipv4Status::kFragment. `now_us` must
  // not decrease. Each call increments one of the counters `joined`, `completed`, `duplicates`,
  // `overlaps`, `bad` and `refused`, and also counts displaced and expired datagrams.
  Result add(const Ipv4Packet& piece, std::uint64_t now_us, FragmentCounters& counters);

 private:
  struct Extent {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  struct Joining {
    bool is_refused = false;  // the datagram's key is kept until the timeout expires
    Ipv4Packet name;
    std::uint64_t first_us = 0;
    std::uint32_t total_bytes = 0;  // 0 until the last fragment has arrived
    std::uint32_t joined_bytes = 0;
    std::size_t pieces = 0;
    std::array<Extent, kMaxPieces> extents{};  // disjoint extents of the fragments in arrival order
    std::array<std::byte, kMaxBytes> bytes{};
  };

  void expire(std::uint64_t now_us, FragmentCounters& counters);
  // Returns null if fragments from the sender are not accepted.
  [[nodiscard]] Joining* joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                    FragmentCounters& counters);
  [[nodiscard]] Joining& displaced_by(Ipv4Address sender, bool is_its_own);
  [[nodiscard]] static bool is_possible(const Joining& joining, const Extent& extent,
                                        bool has_more);

  // The flags that mark slots as in use are stored in one word, so that scans do not access the
  // memory of unused slots.
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
