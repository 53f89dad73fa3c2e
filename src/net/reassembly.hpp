// Fragments of UDP datagrams become datagrams again (RFC 791, section 3.2), in bounded memory.
//
// A lidar whose packets do not fit into one frame sends them in pieces. A datagram is named by its
// source, destination, protocol and identification. It is complete when its pieces, none of which
// may overlap another, are together as long as the last one says. A piece that contradicts another
// ends its whole datagram, and what still comes of it is dropped, too (RFC 5722, section 4); one
// that says again, byte for byte, what is there is a duplicate and does no harm.
//
// Only pieces of listed senders are kept, for each as many datagrams at once as it has streams.
// There is room for all of them, so no sender displaces a datagram of another listed one: a sender
// that begins too many loses its own oldest. If anybody may send, the unlisted ones share the
// remaining room. If that is full, the address with most datagrams gives way, then the datagram of
// which least has come, then the oldest. So a flood of orphans gives way before a unit's datagram.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "net/counters.hpp"
#include "net/ipv4.hpp"

namespace iog::net {

// The senders whose pieces are kept. At most kMostSenders addresses, and kMostDatagrams together.
class FragmentSenders {
 public:
  // A car has eight sensors, each of which sends one datagram after the other, poses and maps, and
  // a replayer of all these sensors.
  static constexpr std::size_t kMostDatagrams = 8 + 2 + 8;
  static constexpr std::size_t kMostSenders = 8 + 2 + 1;

  // Allows this sender that many more datagrams at once. 0.0.0.0: each unlisted sender, in the room
  // that the listed ones leave.
  void add(Ipv4Address address, std::size_t datagrams = 1);

  // How many datagrams at once (0: none), and whether room is reserved for them.
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
  std::size_t datagrams_ = 0;  // of all that are listed
};

// 35.7 KB for each datagram, 642 KB.
class Reassembly {
 public:
  static constexpr std::size_t kDatagrams = FragmentSenders::kMostDatagrams;
  // The longest payload of a unit, 35,336 bytes of a Continental ARS548 (an Ouster of 128 rows with
  // two returns has 33,024), and the UDP header.
  static constexpr std::size_t kMaxBytes = 35'336 + 8;
  // 35,344 bytes in pieces of 1480 are 24. No sender makes pieces smaller than 984 bytes.
  static constexpr std::size_t kMaxPieces = 36;
  // From the first piece that came. The pieces of one datagram follow one another within 3 ms at
  // 100 Mbit/s; the identification of a lidar that sends 1,280 a second repeats after 51 s.
  static constexpr std::uint64_t kTimeoutUs = 100'000;

  enum class Fate : std::uint8_t {
    kJoined,     // waits for the rest
    kCompleted,  // `packet` is the whole
    kDropped,
  };
  struct [[nodiscard]] Result {
    Fate fate = Fate::kDropped;
    // Only with kCompleted; the payload is valid until the next add(). Of so many pieces.
    Ipv4Packet packet{};
    std::size_t pieces = 0;
  };

  explicit Reassembly(const FragmentSenders& senders) : senders_(senders) {}
  // Of whoever sends, as who reads a capture wants it.
  Reassembly() { senders_.add({}, kDatagrams); }

  // piece: of an Ipv4Status::kFragment. now_us never goes backwards. Each call counts one of
  // joined, completed, duplicates, overlaps, bad and refused, and whatever it displaces or finds
  // expired.
  Result add(const Ipv4Packet& piece, std::uint64_t now_us, FragmentCounters& counters);

 private:
  struct Extent {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  struct Joining {
    bool is_refused = false;  // given up; its name is kept until it expires
    Ipv4Packet name;
    std::uint64_t first_us = 0;
    std::uint32_t total_bytes = 0;  // 0: the last piece has not come
    std::uint32_t joined_bytes = 0;
    std::size_t pieces = 0;
    std::array<Extent, kMaxPieces> extents{};  // of the pieces, disjoint, as they came
    std::array<std::byte, kMaxBytes> bytes{};
  };

  void expire(std::uint64_t now_us, FragmentCounters& counters);
  // None: nothing is kept of this sender.
  [[nodiscard]] Joining* joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                    FragmentCounters& counters);
  [[nodiscard]] Joining& displaced_by(Ipv4Address sender, bool is_its_own);
  [[nodiscard]] static bool is_possible(const Joining& joining, const Extent& extent,
                                        bool has_more);

  // Kept apart, so that the many unopened ones need not be read.
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
