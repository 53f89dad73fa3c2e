// From a unit's TCP connection to datagrams: bytes that are cut anywhere, and a unit on 127.0.0.1
// that comes and goes.
#include "tools/relay/relay.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "fakes/bytes_of.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/relay/scan_stream.hpp"

namespace iog::tools {
namespace {

using std::chrono::milliseconds;
using tests::Bytes;
using tests::joined;

Bytes scan(int number, int points = 3) {
  tests::LuxMessage message{.scan_number = number};
  for (int i = 0; i < points; ++i) {
    message.points.push_back({.layer = i % 4, .angle_ticks = 1600 - i, .range_cm = i});
  }
  return message.bytes();
}

// An error message, data type 0x2030.
Bytes other_message() {
  Bytes bytes = scan(0, 0);
  bytes.resize(24 + 16);
  bytes[11] = std::byte{16};
  bytes[14] = std::byte{0x20};
  bytes[15] = std::byte{0x30};
  return bytes;
}

Bytes letters(const std::string& text) {
  Bytes bytes;
  std::ranges::transform(text, std::back_inserter(bytes),
                         [](char letter) { return static_cast<std::byte>(letter); });
  return bytes;
}

struct Heard {
  std::vector<int> numbers;
  ScanStream::Counts counts;
};

// In pieces of random sizes up to `longest`.
Heard heard(const Bytes& bytes, std::int32_t longest, std::uint64_t seed) {
  tests::Random random(seed);
  ScanStream stream;
  Heard heard;
  std::span<const std::byte> rest = bytes;
  while (!rest.empty()) {
    const auto size =
        std::min<std::size_t>(rest.size(), static_cast<std::size_t>(random.between(1, longest)));
    stream.take(rest.first(size),
                [&](const LuxScan& scan) { heard.numbers.push_back(scan.scan_number); });
    rest = rest.subspan(size);
  }
  heard.counts = stream.counts();
  return heard;
}

TEST(ScanStream, HearsTheSameHoweverTheBytesAreCut) {
  const Bytes magic = letters("\xAF\xFE\xC0\xC2");
  const Bytes bytes =
      joined({letters("garbage"), scan(1), other_message(), magic, scan(2, 500),
              letters("\xAF\xFE"), scan(3, 0), magic, magic, letters("x"), scan(4)});
  const Heard whole{.numbers = {1, 2, 3, 4},
                    .counts = {.scans = 4, .other_messages = 1, .skipped_bytes = 7 + 4 + 2 + 9}};
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    ASSERT_EQ(heard(bytes, 1 + static_cast<std::int32_t>(seed), seed).numbers, whole.numbers);
    ASSERT_EQ(heard(bytes, 1 + static_cast<std::int32_t>(seed), seed).counts, whole.counts);
  }
}

// Each scan is told with its last byte, and not when the next one comes.
TEST(ScanStream, TellsAScanWithItsLastByte) {
  ScanStream stream;
  int scans = 0;
  const Bytes bytes = scan(1);
  const auto count = [&](const LuxScan& /*scan*/) { ++scans; };
  stream.take(std::span(bytes).first(bytes.size() - 1), count);
  EXPECT_EQ(scans, 0);
  stream.take(std::span(bytes).last(1), count);
  EXPECT_EQ(scans, 1);
  EXPECT_EQ(stream.held_bytes(), 0U);
}

TEST(ScanStream, AScanThatContradictsItselfIsDroppedAlone) {
  Bytes wrong = scan(2);
  wrong.at(24 + 44) = std::byte{0x04};  // layer 4
  const Heard all = heard(joined({scan(1), wrong, scan(3)}), 1'000, 1);
  EXPECT_EQ(all.numbers, (std::vector{1, 3}));
  EXPECT_EQ(all.counts.malformed, 1U);
  EXPECT_EQ(all.counts.skipped_bytes, 0U);
}

// A header may claim 4 GB, and one of another message that it takes the next ones in; neither of
// them is believed.
TEST(ScanStream, ALengthThatCannotBeIsNotBelieved) {
  for (const std::size_t where : {std::size_t{8}, std::size_t{9}, std::size_t{10}}) {
    Bytes boastful = scan(1);
    boastful.at(where) = std::byte{0xFF};
    EXPECT_EQ(heard(joined({boastful, scan(2)}), 100, where).numbers, (std::vector{2}));
    Bytes other = other_message();
    other.at(where) = std::byte{0x01};
    const Bytes bytes = joined({other, scan(2), scan(3, 100)});
    EXPECT_EQ(heard(bytes, 100, where).numbers, (std::vector{2, 3}));
  }
}

TEST(ScanStream, HoldsNoMoreThanAMessage) {
  tests::Random random(5);
  ScanStream stream;
  const auto ignore = [](const LuxScan& /*scan*/) {};
  for (int round = 0; round < 3'000; ++round) {
    Bytes piece(static_cast<std::size_t>(random.between(1, 500)));
    for (std::byte& byte : piece) {
      // Mostly of what headers are made of.
      constexpr std::array kHeader{0xAF, 0xFE, 0xC0, 0xC2, 0x22, 0x02, 0x00, 0x20};
      byte = static_cast<std::byte>(kHeader.at(random.below(kHeader.size())));
    }
    stream.take(piece, ignore);
    ASSERT_LE(stream.held_bytes(), ScanStream::kMostScanBytes);
  }
}

// Waits on 127.0.0.1 for somebody to connect, as a unit does.
class FakeUnit {
 public:
  // port 0: any that is free.
  explicit FakeUnit(std::uint16_t port = 0) : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    const int yes = 1;
    setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in here = address(port);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&here), sizeof here), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    socklen_t size = sizeof here;
    EXPECT_EQ(getsockname(listener_, reinterpret_cast<sockaddr*>(&here), &size), 0);
    port_ = ntohs(here.sin_port);
  }
  ~FakeUnit() {
    hang_up();
    close(listener_);
  }
  FakeUnit(const FakeUnit&) = delete;
  FakeUnit& operator=(const FakeUnit&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  void answer() { connection_ = accept(listener_, nullptr, nullptr); }
  void send(std::span<const std::byte> bytes) const {
    EXPECT_EQ(::send(connection_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  void hang_up() {
    if (connection_ >= 0) {
      close(std::exchange(connection_, -1));
    }
  }

 private:
  static sockaddr_in address(std::uint16_t port) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    here.sin_port = htons(port);
    return here;
  }

  int listener_;
  int connection_ = -1;
  std::uint16_t port_ = 0;
};

// A relay whose datagrams are kept.
struct Relayed {
  explicit Relayed(const std::vector<std::uint16_t>& tcp_ports,
                   UnitLink::Patience patience = {milliseconds{20}, milliseconds{5'000}})
      : relay(
            units(tcp_ports),
            [this](std::size_t unit, std::span<const std::byte> datagram) {
              datagrams.emplace_back(unit, Bytes(datagram.begin(), datagram.end()));
              return is_network_up;
            },
            [this](const std::string& line) { lines.push_back(line); }, patience) {}

  static std::vector<RelayedUnit> units(const std::vector<std::uint16_t>& tcp_ports) {
    std::vector<RelayedUnit> all;
    all.reserve(tcp_ports.size());
    for (const std::uint16_t port : tcp_ports) {
      all.push_back({"unit" + std::to_string(all.size()), "127.0.0.1", port});
    }
    return all;
  }

  // Until that is so; not for ever.
  template <typename Condition>
  [[nodiscard]] bool runs_until(Condition&& is_so) {
    const auto end = UnitLink::Clock::now() + std::chrono::seconds{10};
    while (!is_so() && UnitLink::Clock::now() < end) {
      relay.wait(milliseconds{5});
    }
    return is_so();
  }
  [[nodiscard]] bool connects(FakeUnit& unit, std::size_t which = 0) {
    const std::uint64_t before = relay.link(which).counts().connections;
    const bool is_there =
        runs_until([&] { return relay.link(which).counts().connections > before; });
    unit.answer();
    return is_there;
  }

  bool is_network_up = true;
  std::vector<std::pair<std::size_t, Bytes>> datagrams;
  std::vector<std::string> lines;
  Relay relay;
};

TEST(Relay, ScansBecomeDatagrams) {
  FakeUnit unit;
  Relayed relayed({unit.port()});
  ASSERT_TRUE(relayed.connects(unit));
  const Bytes bytes = joined({scan(7), other_message(), scan(8, 1'000)});
  for (std::size_t at = 0; at < bytes.size(); at += 777) {
    unit.send(std::span(bytes).subspan(at, std::min<std::size_t>(777, bytes.size() - at)));
  }
  const auto all_is_there = [&] { return relayed.relay.link(0).scan_counts().scans == 2; };
  ASSERT_TRUE(relayed.runs_until(all_is_there));
  EXPECT_EQ(relayed.datagrams.front().second, scan(7));
  // 1,000 points of 10 bytes, of which a datagram of 1,400 holds 133.
  EXPECT_EQ(relayed.datagrams.size(), 1U + 8U);
  std::size_t points = 0;
  for (const auto& [which, datagram] : relayed.datagrams) {
    lidar::IbeoLux packet;
    ASSERT_EQ(packet.decode(datagram), lidar::DecodeStatus::kOk);
    EXPECT_LE(datagram.size(), 1'400U);
    points += packet.info().point_count;
  }
  EXPECT_EQ(points, 1'003U);
  EXPECT_EQ(relayed.relay.words_of(0),
            "unit0: 2 scans, 9 datagrams sent, 0 refused by the system; 1 other message, 0 "
            "malformed, 0 bytes skipped; 1 connection, 0 lost");
}

TEST(Relay, UnitsAreNotMixedUp) {
  FakeUnit left;
  FakeUnit right;
  Relayed relayed({left.port(), right.port()});
  ASSERT_TRUE(relayed.runs_until([&] {
    return relayed.relay.link(0).is_connected() && relayed.relay.link(1).is_connected();
  }));
  left.answer();
  right.answer();
  const Bytes half = scan(1);
  left.send(std::span(half).first(30));
  right.send(scan(2));
  ASSERT_TRUE(relayed.runs_until([&] { return relayed.datagrams.size() == 1; }));
  left.send(std::span(half).subspan(30));
  ASSERT_TRUE(relayed.runs_until([&] { return relayed.datagrams.size() == 2; }));
  EXPECT_EQ(relayed.datagrams[0], (std::pair{std::size_t{1}, scan(2)}));
  EXPECT_EQ(relayed.datagrams[1], (std::pair{std::size_t{0}, scan(1)}));
}

// What was cut off with the connection is no begin of what the next one brings.
TEST(Relay, ConnectsAgain) {
  FakeUnit unit;
  Relayed relayed({unit.port()});
  for (int round = 1; round <= 3; ++round) {
    ASSERT_TRUE(relayed.connects(unit));
    unit.send(scan(round));
    const Bytes cut = scan(99);
    unit.send(std::span(cut).first(60));
    unit.hang_up();
    ASSERT_TRUE(relayed.runs_until([&] {
      return relayed.relay.link(0).counts().losses == static_cast<std::uint64_t>(round);
    }));
  }
  ASSERT_EQ(relayed.datagrams.size(), 3U);
  for (int round = 1; round <= 3; ++round) {
    EXPECT_EQ(relayed.datagrams[static_cast<std::size_t>(round - 1)].second, scan(round));
  }
  EXPECT_EQ(relayed.relay.link(0).scan_counts().skipped_bytes, 3U * 60U);
}

TEST(Relay, WaitsForAUnitThatIsNotThere) {
  std::uint16_t port = 0;
  {
    const FakeUnit unit;
    port = unit.port();
  }
  Relayed relayed({port});
  ASSERT_TRUE(relayed.runs_until([&] { return !relayed.lines.empty(); }));
  EXPECT_EQ(relayed.lines[0],
            "unit0 at 127.0.0.1:" + std::to_string(port) + ": Connection refused; trying again");
  for (int i = 0; i < 20; ++i) {
    relayed.relay.wait(milliseconds{5});
  }
  EXPECT_EQ(relayed.lines.size(), 1U);  // told once, however often it tries
  FakeUnit unit(port);
  ASSERT_TRUE(relayed.connects(unit));
  EXPECT_EQ(relayed.lines.back(), "unit0 at 127.0.0.1:" + std::to_string(port) + ": connected");
  EXPECT_EQ(relayed.relay.link(0).counts().losses, 0U);
}

// A cable that was pulled ends no connection.
TEST(Relay, GivesUpAConnectionThatFallsSilent) {
  FakeUnit unit;
  Relayed relayed({unit.port()}, {milliseconds{20}, milliseconds{60}});
  ASSERT_TRUE(relayed.connects(unit));
  ASSERT_TRUE(relayed.runs_until([&] { return relayed.relay.link(0).counts().losses == 1; }));
  EXPECT_EQ(relayed.relay.link(0).last_fault(), "it fell silent");
  unit.hang_up();
  ASSERT_TRUE(relayed.connects(unit));
}

TEST(Relay, CountsWhatTheSystemRefuses) {
  FakeUnit unit;
  Relayed relayed({unit.port()});
  relayed.is_network_up = false;
  ASSERT_TRUE(relayed.connects(unit));
  unit.send(scan(1));
  ASSERT_TRUE(relayed.runs_until([&] { return relayed.relay.counts(0).refused == 1; }));
  EXPECT_EQ(relayed.relay.counts(0).sent, 0U);
}

TEST(Relay, AnAddressIsFourNumbers) {
  EXPECT_THROW(UnitLink("lidar.local", 1, {}), UsageError);
  EXPECT_THROW(UnitLink("", 1, {}), UsageError);
}

}  // namespace
}  // namespace iog::tools
