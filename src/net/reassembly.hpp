// Fragments of UDP datagrams become datagrams again (RFC 791, section 3.2), in bounded memory.
//
// A lidar whose packets do not fit into one frame sends them in pieces. A datagram is named by its
// source, destination, protocol and identification. It is complete when its pieces, none of which
// may overlap another, are together as long as the last one says. A piece that contradicts another
// ends its whole datagram, and what still comes of it is dropped, too (RFC 5722, section 4); one
// that says again, byte for byte, what is there is a duplicate and does no harm.
//
// There is room for kDatagrams at once. If another one begins, the oldest is displaced, so that
// forged pieces delay others for no longer than their own number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "net/counters.hpp"
#include "net/ipv4.hpp"

namespace iog::net {

class Reassembly {
 public:
  // Each lidar sends one datagram after the other, so as many as there are lidars that do so.
  static constexpr std::size_t kDatagrams = 4;
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
    bool is_open = false;
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
  [[nodiscard]] Joining& joining_of(const Ipv4Packet& piece, std::uint64_t now_us,
                                    FragmentCounters& counters);
  [[nodiscard]] static bool is_possible(const Joining& joining, const Extent& extent,
                                        bool has_more);

  std::array<Joining, kDatagrams> joinings_{};
};

}  // namespace iog::net
