// Fragments become their datagram, whatever the order they come in (RFC 791, section 3.2), and no
// datagram ever holds a byte that its sender did not send (RFC 5722).
#include "net/reassembly.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "fakes/random.hpp"
#include "net/frames.hpp"
#include "net/station.hpp"

namespace iog::net::testing {
namespace {

using Bytes = std::vector<std::byte>;
using Fate = Reassembly::Fate;

Bytes random_bytes(std::size_t size, tests::Random& random) {
  Bytes bytes(size);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(random.next());
  }
  return bytes;
}

constexpr Ipv4Address kUnit = ipv4(10, 0, 2, 101);

struct Piece {
  std::uint32_t offset = 0;
  bool has_more = false;
  Bytes bytes;
  std::uint16_t identification = 7;
  Ipv4Address source = kUnit;

  [[nodiscard]] Ipv4Packet packet() const {
    return {.source = source,
            .destination = ipv4(10, 0, 2, 15),
            .protocol = kProtocolUdp,
            .identification = identification,
            .fragment_offset = offset,
            .has_more_fragments = has_more,
            .payload = bytes};
  }
};

std::vector<Piece> cut(const Bytes& whole, std::size_t piece_bytes, std::uint16_t name = 7,
                       Ipv4Address source = kUnit) {
  std::vector<Piece> pieces;
  for (std::size_t at = 0; at < whole.size(); at += piece_bytes) {
    const std::size_t end = std::min(whole.size(), at + piece_bytes);
    pieces.push_back({.offset = static_cast<std::uint32_t>(at),
                      .has_more = end < whole.size(),
                      .bytes = Bytes(whole.begin() + static_cast<std::ptrdiff_t>(at),
                                     whole.begin() + static_cast<std::ptrdiff_t>(end)),
                      .identification = name,
                      .source = source});
  }
  return pieces;
}

class ReassemblyTest : public ::testing::Test {
 protected:
  Fate take(const Piece& piece, std::uint64_t now_us = 0) {
    const Reassembly::Result result = reassembly_->add(piece.packet(), now_us, counters_);
    whole_.assign(result.packet.payload.begin(), result.packet.payload.end());
    name_ = result.packet.identification;
    return result.fate;
  }

  tests::Random random_{791};
  std::unique_ptr<Reassembly> reassembly_ = std::make_unique<Reassembly>();
  FragmentCounters counters_;
  Bytes whole_;
  std::uint16_t name_ = 0;
};

TEST_F(ReassemblyTest, InWhateverOrderTheyCome) {
  for (int round = 0; round < 200; ++round) {
    const Bytes whole = random_bytes(1 + random_.below(Reassembly::kMaxBytes), random_);
    auto pieces = cut(whole, 1040 + 8 * random_.below(56));
    if (pieces.size() == 1) {
      continue;  // no fragment
    }
    for (std::size_t i = pieces.size(); i > 1; --i) {
      std::swap(pieces[i - 1], pieces[random_.below(i)]);
    }
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      ASSERT_EQ(take(pieces[i]), Fate::kJoined);
    }
    ASSERT_EQ(take(pieces.back()), Fate::kCompleted);
    ASSERT_EQ(whole_, whole);
  }
  EXPECT_EQ(counters_.bad + counters_.overlaps + counters_.expired + counters_.displaced, 0U);
}

TEST_F(ReassemblyTest, TheLongestDatagramFitsAndNoneBeyondIt) {
  const auto longest = cut(random_bytes(Reassembly::kMaxBytes, random_), 1480);
  ASSERT_EQ(longest.size(), 24U);
  for (const Piece& piece : longest) {
    ASSERT_EQ(take(piece), piece.has_more ? Fate::kJoined : Fate::kCompleted);
  }
  Piece beyond{.offset = 35'336, .has_more = false, .bytes = Bytes(9)};
  EXPECT_EQ(take(beyond), Fate::kDropped);
  EXPECT_EQ(counters_.bad, 1U);
}

TEST_F(ReassemblyTest, ADuplicateDoesNoHarm) {
  const Bytes whole = random_bytes(4000, random_);
  const auto pieces = cut(whole, 1480);
  EXPECT_EQ(take(pieces[2]), Fate::kJoined);
  EXPECT_EQ(take(pieces[0]), Fate::kJoined);
  EXPECT_EQ(take(pieces[0]), Fate::kDropped);
  EXPECT_EQ(take(pieces[2]), Fate::kDropped);
  EXPECT_EQ(counters_.duplicates, 2U);
  EXPECT_EQ(take(pieces[1]), Fate::kCompleted);
  EXPECT_EQ(whole_, whole);
}

// RFC 5722, section 4: the datagram is discarded, and so is what still comes of it.
TEST_F(ReassemblyTest, AnOverlapEndsItsDatagram) {
  const auto pieces = cut(random_bytes(4000, random_), 1480);
  Piece changed = pieces[0];
  changed.bytes[3] ^= std::byte{1};
  Piece shifted = pieces[0];
  shifted.offset = 1472;
  for (const Piece& contradiction : {changed, shifted}) {
    const FragmentCounters before = counters_;
    EXPECT_EQ(take(pieces[0]), Fate::kJoined);
    EXPECT_EQ(take(contradiction), Fate::kDropped);
    EXPECT_EQ(take(pieces[1]), Fate::kDropped);
    EXPECT_EQ(take(pieces[2]), Fate::kDropped);
    EXPECT_EQ(counters_.overlaps, before.overlaps + 1);
    EXPECT_EQ(counters_.refused, before.refused + 2);
    reassembly_ = std::make_unique<Reassembly>();
  }
}

TEST_F(ReassemblyTest, ALengthThatCannotBeEndsItsDatagram) {
  const std::vector<std::vector<Piece>> impossible{
      {{0, true, Bytes(1479)}},                       // not the last, and no whole units
      {{0, true, {}}},                                // nothing
      {{8, false, Bytes(8)}, {16, false, Bytes(8)}},  // two ends
      {{16, true, Bytes(8)}, {8, false, Bytes(8)}},   // something behind the end
      {{8, false, Bytes(8)}, {16, true, Bytes(8)}},   // likewise
      {{8, false, Bytes(8)}, {0, true, Bytes(16)}},   // more after the end
      {{40'000, true, Bytes(8)}},                     // beyond the longest
      {{65'528, false, Bytes(1400)}},                 // beyond what IPv4 can say
  };
  for (const auto& pieces : impossible) {
    const std::uint32_t before = counters_.bad;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      EXPECT_EQ(take(pieces[i]), Fate::kJoined);
    }
    EXPECT_EQ(take(pieces.back()), Fate::kDropped);
    EXPECT_EQ(counters_.bad, before + 1);
    EXPECT_EQ(take({.offset = 0, .has_more = true, .bytes = Bytes(8)}), Fate::kDropped);
    reassembly_ = std::make_unique<Reassembly>();
  }
}

TEST_F(ReassemblyTest, TooManyPiecesAreNobodys) {
  const auto pieces = cut(Bytes(8 * (Reassembly::kMaxPieces + 1)), 8);
  for (std::size_t i = 0; i < Reassembly::kMaxPieces; ++i) {
    ASSERT_EQ(take(pieces[i]), Fate::kJoined);
  }
  EXPECT_EQ(take(pieces.back()), Fate::kDropped);
  EXPECT_EQ(counters_.bad, 1U);
}

// The sender counts its datagrams in 16 bits and begins again.
TEST_F(ReassemblyTest, AnOldDatagramOfTheSameNameIsForgotten) {
  const auto old = cut(random_bytes(4000, random_), 1480);
  const Bytes whole = random_bytes(4000, random_);
  const auto pieces = cut(whole, 1480);
  EXPECT_EQ(take(old[0], 0), Fate::kJoined);
  EXPECT_EQ(take(pieces[0], Reassembly::kTimeoutUs + 1), Fate::kJoined);
  EXPECT_EQ(counters_.expired, 1U);
  EXPECT_EQ(take(pieces[1], Reassembly::kTimeoutUs + 2), Fate::kJoined);
  EXPECT_EQ(take(pieces[2], 2 * Reassembly::kTimeoutUs + 1), Fate::kCompleted);
  EXPECT_EQ(whole_, whole);
}

TEST_F(ReassemblyTest, TheOldestGivesWay) {
  std::vector<std::vector<Piece>> datagrams;
  for (std::uint16_t name = 0; name <= Reassembly::kDatagrams; ++name) {
    datagrams.push_back(cut(random_bytes(2000, random_), 1480, name));
    EXPECT_EQ(take(datagrams.back()[0], 10 + name), Fate::kJoined);
  }
  EXPECT_EQ(counters_.displaced, 1U);
  for (std::uint16_t name = 1; name <= Reassembly::kDatagrams; ++name) {
    EXPECT_EQ(take(datagrams[name][1], 100), Fate::kCompleted) << name;
    EXPECT_EQ(name_, name);
  }
  EXPECT_EQ(take(datagrams[0][1], 100), Fate::kJoined) << "its first piece is gone";
}

// An orphan is a last piece whose others never come.
Piece orphan(std::uint16_t name, Ipv4Address source) {
  return {.offset = 1480, .bytes = Bytes(8), .identification = name, .source = source};
}

// As many of a foreign address as one likes, four between any two pieces.
TEST_F(ReassemblyTest, AStrangersFragmentsDisplaceNoSendersDatagram) {
  FragmentSenders senders;
  senders.add(kUnit);
  reassembly_ = std::make_unique<Reassembly>(senders);
  std::uint16_t strangers = 0;
  for (std::uint16_t name = 0; name < 128; ++name) {
    for (const Piece& piece : cut(Bytes(12'616), 1480, name)) {  // of an OS1-64
      for (int i = 0; i < 4; ++i) {
        ++strangers;
        EXPECT_EQ(take(orphan(strangers, ipv4(10, 0, 2, 66))), Fate::kDropped);
        EXPECT_EQ(take(orphan(7, {ipv4(10, 0, 3, 0).value + strangers})), Fate::kDropped);
      }
      ASSERT_EQ(take(piece), piece.has_more ? Fate::kJoined : Fate::kCompleted);
    }
  }
  EXPECT_EQ(counters_.refused, 2U * strangers);
  EXPECT_EQ(counters_.displaced + counters_.expired, 0U);
}

// Five Continental ARS548 at once, piece by piece in turns, of their own addresses or of the one
// that replays them.
TEST_F(ReassemblyTest, FiveUnitsThatSendAtOnceAreJoined) {
  for (const bool is_replayed : {false, true}) {
    FragmentSenders senders;
    std::vector<std::vector<Piece>> lists;
    for (std::uint16_t unit = 0; unit < 5; ++unit) {
      const Ipv4Address source = is_replayed ? ipv4(10, 0, 2, 2) : Ipv4Address{kUnit.value + unit};
      senders.add(source);
      lists.push_back(cut(random_bytes(Reassembly::kMaxBytes, random_), 1480, unit, source));
    }
    reassembly_ = std::make_unique<Reassembly>(senders);
    for (std::size_t piece = 0; piece < lists[0].size(); ++piece) {
      for (const auto& list : lists) {
        ASSERT_EQ(take(list[piece]), list[piece].has_more ? Fate::kJoined : Fate::kCompleted);
      }
    }
  }
}

// Nor does a unit that runs wild take another unit's room.
TEST_F(ReassemblyTest, WhoBeginsMoreThanItsShareGivesUpItsOwnOldest) {
  FragmentSenders senders;
  senders.add(kUnit);
  const Ipv4Address wild = ipv4(10, 0, 2, 102);
  senders.add(wild, 2);
  reassembly_ = std::make_unique<Reassembly>(senders);
  const auto pieces = cut(random_bytes(2000, random_), 1480);
  EXPECT_EQ(take(pieces[0]), Fate::kJoined);
  const auto its = cut(random_bytes(2000, random_), 1480, 2, wild);
  EXPECT_EQ(take(orphan(1, wild), 1), Fate::kJoined);
  EXPECT_EQ(take(its[0], 2), Fate::kJoined);
  EXPECT_EQ(take(orphan(3, wild), 3), Fate::kJoined);
  EXPECT_EQ(take(its[1], 4), Fate::kCompleted);
  EXPECT_EQ(take(pieces[1], 6), Fate::kCompleted);
}

// Of a car whose sensor has no address, and of a capture: neither a flood of one foreign address
// nor one of many displaces the unit's datagram, of which more has come.
TEST_F(ReassemblyTest, WhereAnybodyMaySendAFloodOfOrphansGivesWay) {
  for (const std::size_t datagrams : {std::size_t{1}, Reassembly::kDatagrams}) {
    FragmentSenders senders;
    senders.add({}, datagrams);
    senders.add(ipv4(10, 0, 2, 2));  // who replays
    reassembly_ = std::make_unique<Reassembly>(senders);
    std::uint16_t strangers = 0;
    for (std::uint16_t name = 0; name < 128; ++name) {
      for (const Piece& piece : cut(Bytes(12'616), 1480, name)) {
        ASSERT_EQ(take(piece, name), piece.has_more ? Fate::kJoined : Fate::kCompleted);
        for (int i = 0; i < 4; ++i) {
          ++strangers;
          EXPECT_EQ(take(orphan(strangers, ipv4(10, 0, 2, 66)), name), Fate::kJoined);
          EXPECT_EQ(take(orphan(7, {ipv4(10, 1, 0, 0).value + strangers}), name), Fate::kJoined);
        }
      }
    }
  }
  EXPECT_EQ(counters_.completed, 256U);
}

// Against a slow reference of one datagram: all bytes by their place, each from one piece only.
TEST_F(ReassemblyTest, WhatIsCompletedWasSentSo) {
  int completed = 0;
  for (int round = 0; round < 3000; ++round) {
    std::map<std::uint32_t, std::byte> bytes;
    std::optional<std::uint32_t> end;
    reassembly_ = std::make_unique<Reassembly>();
    for (int i = 0; i < 8; ++i) {
      Piece piece{.offset = 8 * static_cast<std::uint32_t>(random_.below(6)),
                  .has_more = !random_.one_in(3),
                  .bytes = Bytes(random_.below(3) * 8 + (random_.one_in(6) ? 5 : 0),
                                 static_cast<std::byte>(random_.below(2)))};
      const Fate fate = take(piece);
      const std::uint32_t piece_end = piece.offset + static_cast<std::uint32_t>(piece.bytes.size());
      if (fate == Fate::kDropped) {
        continue;
      }
      for (std::uint32_t at = piece.offset; at < piece_end; ++at) {
        ASSERT_TRUE(bytes.emplace(at, piece.bytes[at - piece.offset]).second) << "said twice";
      }
      ASSERT_FALSE(!piece.has_more && end);
      end = piece.has_more ? end : piece_end;
      const bool is_whole = end && bytes.size() == *end && bytes.rbegin()->first == *end - 1;
      ASSERT_EQ(fate == Fate::kCompleted, is_whole);
      if (is_whole) {
        Bytes expected;
        for (const auto& [at, byte] : bytes) {
          expected.push_back(byte);
        }
        ASSERT_EQ(whole_, expected);
        ++completed;
        break;
      }
    }
  }
  EXPECT_GT(completed, 100);
}

Frame frame_of(const Piece& piece) {
  Frame frame = linux_udp_even();
  frame.resize(kUdpOffset);
  frame.insert(frame.end(), piece.bytes.begin(), piece.bytes.end());
  put_be16(frame, kIpOffset + 2, frame.size() - kIpOffset);
  put_be16(frame, kIpOffset + 4, piece.identification);
  put_be16(frame, kIpOffset + 6, piece.offset / 8 | (piece.has_more ? 0x2000U : 0U));
  fix_ip_checksum(frame);
  return frame;
}

struct JoiningStation : Station {
  JoiningStation() { host.join_fragments(*reassembly); }
  std::unique_ptr<Reassembly> reassembly = std::make_unique<Reassembly>();
};

// A UDP datagram of z, as its header and payload.
Bytes udp_datagram(std::size_t payload_bytes, std::uint16_t checksum) {
  Bytes udp = from_hex("4a38 1b58 0000 0000");
  udp.resize(8 + payload_bytes, std::byte{'z'});
  put_be16(udp, 4, udp.size());
  put_be16(udp, 6, checksum);
  return udp;
}

TEST(HostFragments, WithoutMemoryEveryFragmentIsDropped) {
  Station station;
  EXPECT_FALSE(station.take(frame_of(cut(udp_datagram(2'000, 0), 1480)[0])));
  EXPECT_EQ(station.dropped(Drop::kFragment), 1U);
}

TEST(HostFragments, ADatagramInFragmentsIsDeliveredWhole) {
  JoiningStation station;
  const auto pieces = cut(udp_datagram(12'608, 0), 1480);  // a packet of an OS1-64
  ASSERT_EQ(pieces.size(), 9U);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    ASSERT_FALSE(station.take(frame_of(pieces[i])));
    ASSERT_TRUE(station.conserved());
  }
  const auto datagram = station.take(frame_of(pieces.back()));
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->payload.size(), 12'608U);
  EXPECT_EQ(datagram->destination_port, 7000);
  EXPECT_EQ(datagram->source, ipv4(10, 0, 2, 2));
  EXPECT_EQ(station.host.counters().fragments.joined, 8U);
  EXPECT_TRUE(station.conserved());
}

// The checksum of UDP covers the whole, so that pieces of two datagrams do not pass for one.
TEST(HostFragments, AWrongChecksumOfTheWholeIsNoticed) {
  JoiningStation station;
  const auto pieces = cut(udp_datagram(2'000, 0x1234), 1480);
  EXPECT_FALSE(station.take(frame_of(pieces[0])));
  EXPECT_FALSE(station.take(frame_of(pieces[1])));
  EXPECT_EQ(station.dropped(Drop::kBadUdpChecksum), 1U);
  EXPECT_TRUE(station.conserved());
}

TEST(HostFragments, OnlyThoseOfUdpToUsAreKept) {
  JoiningStation station;
  Frame icmp = frame_of({.offset = 8, .has_more = true, .bytes = Bytes(8)});
  icmp[kIpOffset + 9] = std::byte{1};
  fix_ip_checksum(icmp);
  EXPECT_FALSE(station.take(icmp));
  EXPECT_EQ(station.dropped(Drop::kFragment), 1U);
  Frame others = frame_of({.offset = 8, .has_more = true, .bytes = Bytes(8)});
  others[kIpOffset + 19] = std::byte{99};
  fix_ip_checksum(others);
  EXPECT_FALSE(station.take(others));
  EXPECT_EQ(station.dropped(Drop::kNotForUsIp), 1U);
  EXPECT_EQ(station.host.counters().fragments.joined, 0U);
  EXPECT_TRUE(station.conserved());
}

}  // namespace
}  // namespace iog::net::testing
