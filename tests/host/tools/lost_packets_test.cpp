// Packets that a recording lacks leave holes in a plausible grid.
#include "tools/identity/lost_packets.hpp"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <string>

#include "drive_sample.hpp"
#include "tools/identity/car_clocks.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kTurn = 36'000;
constexpr std::uint64_t kBeginUs = 3'599'000'000;  // the hour ends within the recording
constexpr std::uint32_t kAddress = 0xC0A801C9;

// A unit of 75 packets a turn, clockwise. The sector of each is a little wider than its step.
struct Unit {
  std::uint64_t packets_of_turn = 75;
  std::uint64_t turn_us = 100'000;

  [[nodiscard]] lidar::PacketInfo packet(std::uint64_t number) const {
    const std::uint64_t step = kTurn / packets_of_turn;
    const std::uint64_t end = (number + 1) * step % kTurn;
    return {.fingerprint = number,
            .sector = {.first_ticks = static_cast<std::uint16_t>((kTurn - end) % kTurn),
                       .width_ticks = static_cast<std::uint16_t>(step + 10)},
            .sweep = {.begin_us = (kBeginUs + number * turn_us / packets_of_turn) % 3'600'000'000,
                      .is_of_hour = true}};
  }
};

using IsKept = std::function<bool(std::uint64_t number)>;

// 40 turns of it, but for some packets.
std::string told(const Unit& unit, const IsKept& is_kept) {
  LostPackets lost;
  for (std::uint64_t i = 0; i < 40 * unit.packets_of_turn; ++i) {
    if (is_kept(i)) {
      lost.add(unit.packet(i), kAddress, kTurn);
    }
  }
  return lost.words("roof");
}

// By "about 900 of 3000 packets ...".
void expect_lost(const std::string& words, int count, int all) {
  ASSERT_TRUE(words.starts_with("about ")) << words;
  EXPECT_NEAR(std::stoi(words.substr(6)), count, count / 50) << words;
  EXPECT_NEAR(std::stoi(words.substr(words.find(" of ") + 4)), all, count / 50) << words;
}

TEST(LostPackets, OfAUnitThatTurnsAreTold) {
  for (const double share : {0.02, 0.1, 0.5, 0.7}) {
    std::mt19937 random(1);
    int lost = 0;
    const std::string words = told({}, [&](std::uint64_t /*number*/) {
      const bool is_kept = std::uniform_real_distribution<>()(random) >= share;
      lost += is_kept ? 0 : 1;
      return is_kept;
    });
    expect_lost(words, lost, 3'000);
  }
  EXPECT_EQ(told({}, [](std::uint64_t number) { return number % 10 != 5; }),
            "about 300 of 3000 packets of roof (10 %) are missing, so the grid has gaps: check "
            "the network and the recording PC");
}

// 100 packets, then none for two turns and 25 packets; ten times, and 100 packets.
TEST(LostPackets, WholeTurnsCount) {
  expect_lost(told({}, [](std::uint64_t number) { return number % 275 < 100; }), 1'750, 2'850);
}

TEST(LostPackets, OfAWholeRecordingAreNone) {
  for (const std::uint64_t packets_of_turn : {36UL, 75UL, 150UL, 600UL}) {
    for (const std::uint64_t turn_us : {50'000UL, 100'000UL, 200'000UL}) {
      const Unit unit{.packets_of_turn = packets_of_turn, .turn_us = turn_us};
      EXPECT_EQ(told(unit, [](std::uint64_t /*number*/) { return true; }), "");
    }
  }
}

// Where the field of view begins and ends, packets come in every other turn only. Of those that are
// lost there, the next ones do not tell.
TEST(LostPackets, ALimitedFieldOfViewIsNoLoss) {
  const auto is_within = [](std::uint64_t number, std::uint64_t margin) {
    const std::uint64_t of_turn = number % 75;
    const std::uint64_t edge = number / 75 % 2 + margin;
    return of_turn >= 20 + edge && of_turn < 60 - edge;
  };
  EXPECT_EQ(told({}, [&](std::uint64_t number) { return is_within(number, 0); }), "");
  int lost = 0;
  int kept = 0;
  const std::string words = told({}, [&](std::uint64_t number) {
    const bool is_lost = number % 7 == 0;
    lost += is_lost && is_within(number, 1) ? 1 : 0;
    kept += !is_lost && is_within(number, 0) ? 1 : 0;
    return !is_lost && is_within(number, 0);
  });
  expect_lost(words, lost, kept + lost);
}

TEST(LostPackets, OvertakenAndDamagedPacketsAndPausesAreNoLoss) {
  const Unit unit;
  LostPackets lost;
  for (std::uint64_t i = 0; i < 3'000; ++i) {
    lost.add(unit.packet(i % 5 == 3 ? i + 1 : i % 5 == 4 ? i - 1 : i), kAddress, kTurn);
  }
  EXPECT_EQ(lost.words("roof"), "");
  LostPackets damaged;
  for (std::uint64_t i = 0; i < 3'000; ++i) {
    i % 3 == 0 ? damaged.skip() : damaged.add(unit.packet(i), kAddress, kTurn);
  }
  EXPECT_EQ(damaged.words("roof"), "");
  LostPackets paused;
  for (std::uint64_t i = 0; i < 60'000; ++i) {
    if (i % 1'000 < 50) {
      paused.add(unit.packet(i), kAddress, kTurn);
    }
  }
  EXPECT_EQ(paused.words("roof"), "");
}

// Before its motor runs, a unit sends from one direction or from two that are next to each other.
TEST(LostPackets, AUnitThatStandsLosesNothing) {
  const Unit unit;
  for (const std::uint64_t directions : {1U, 2U}) {
    for (const std::uint64_t every : {1'000'000U, 10U}) {
      LostPackets lost;
      for (std::uint64_t i = 0; i < 6'000; ++i) {
        lidar::PacketInfo packet = unit.packet(i);
        if (i < 3'000) {
          packet.sector.first_ticks = static_cast<std::uint16_t>(1'000 + i % directions);
        }
        if (i < 3'000 || i % every != 5) {
          lost.add(packet, kAddress, kTurn);
        }
      }
      const std::string words = lost.words("roof");
      if (every > 10) {
        EXPECT_EQ(words, "");
      } else {
        expect_lost(words, 300, 6'000);
      }
    }
  }
}

// A mirror port sends each packet twice, the second time at once or a little later.
TEST(LostPackets, CopiesDoNotCount) {
  const Unit unit;
  for (const std::uint64_t later : {0U, 2U}) {
    LostPackets lost;
    for (std::uint64_t i = 0; i < 3'000; ++i) {
      for (const std::uint64_t number : {i, i - std::min(i, later)}) {
        if (number % 10 != 5) {
          lost.add(unit.packet(number), kAddress, kTurn);
        }
      }
    }
    expect_lost(lost.words("roof"), 300, 3'000);
  }
}

// They are told of elsewhere.
TEST(LostPackets, TwoUnitsOnAPortAreNoLoss) {
  const Unit unit;
  LostPackets lost;
  std::mt19937 random(1);
  for (std::uint64_t of_first = 0, of_second = 31; of_first < 3'000;) {
    random() % 2 == 0 ? lost.add(unit.packet(of_first++), kAddress, kTurn)
                      : lost.add(unit.packet(of_second++), kAddress + 1, kTurn);
  }
  EXPECT_EQ(lost.words("roof"), "");
}

// 25 scans a second from number 65,000 on, each in so many messages.
std::string told_of_lux(
    std::uint64_t messages, std::uint64_t step, const IsKept& is_kept,
    const IsKept& is_sound = [](std::uint64_t /*i*/) { return true; }) {
  LostPackets lost;
  for (std::uint64_t i = 0; i < 1'000 * messages; ++i) {
    const std::uint64_t scan = i / messages;
    if (!is_sound(i)) {
      lost.skip();
    } else if (is_kept(i)) {
      lost.add({.fingerprint = i,
                .scan_number = static_cast<std::uint16_t>(65'000 + scan * step),
                .sector = {.width_ticks = static_cast<std::uint16_t>(3'200 / messages)},
                .sweep = {.begin_us = kBeginUs + scan * 40'000}},
               kAddress, 0);
    }
  }
  return lost.words("front");
}

TEST(LostPackets, OfALuxAreTold) {
  const std::string rest = ", so the grid has gaps: check the network and the recording PC";
  EXPECT_EQ(told_of_lux(1, 1, [](std::uint64_t i) { return i % 10 != 5; }),
            "about 100 of 999 scans of front (10 %) are missing" + rest);
  // Each second scan lacks one of two messages.
  EXPECT_EQ(told_of_lux(2, 1, [](std::uint64_t i) { return i % 4 != 1; }),
            "about 250 of 999 scans of front (25 %) are missing" + rest);
}

TEST(LostPackets, OfAWholeRecordingOfALuxAreNone) {
  for (const std::uint64_t messages : {1UL, 2UL, 4UL}) {
    EXPECT_EQ(told_of_lux(messages, 1, [](std::uint64_t /*i*/) { return true; }), "");
    EXPECT_EQ(told_of_lux(messages, 2, [](std::uint64_t /*i*/) { return true; }), "");
  }
  EXPECT_EQ(told_of_lux(1, 1, [](std::uint64_t i) { return i % 200 < 150; }), "");  // pauses
  // Damaged messages came, too.
  EXPECT_EQ(told_of_lux(
                4, 1, [](std::uint64_t /*i*/) { return true; },
                [](std::uint64_t i) { return i % 37 != 0; }),
            "");
}

// A third of the packets of each car's units.
TEST(LostPackets, OfEachMakersUnitAreTold) {
  for (const char* const name : {"reference_car", "roof_vlp16", "roof_os1_64", "roof_xt32"}) {
    const CatalogueEntry& car = find_vehicle(name);
    CarClocks whole(car);
    CarClocks lossy(car);
    std::mt19937 random(1);
    for (const CapturedDatagram& datagram : sample_drive(car, 1, 60)) {
      whole.add(datagram);
      if (random() % 3 > 0) {
        lossy.add(datagram);
      }
    }
    EXPECT_EQ(whole.words_of_lost().size(), 0U) << whole.words_of_lost()[0];
    const std::vector<std::string> words = lossy.words_of_lost();
    EXPECT_EQ(words.size(), car.sensors.size());
    for (const std::string& each : words) {
      EXPECT_NE(each.find(" %) are missing, "), std::string::npos) << each;
    }
  }
}

}  // namespace
}  // namespace iog::tools
