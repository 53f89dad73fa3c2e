// Packets of Ouster and Hesai are known without a description; those of others are none of theirs.
#include "tools/info/unit_guess.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "fakes/hesai_packet.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/velodyne_packet.hpp"

namespace iog::tools {
namespace {

std::string name_guessed(const std::vector<std::byte>& payload) {
  const auto guessed = guess_unit(payload);
  return guessed ? guessed->name : "none";
}

TEST(UnitGuess, KnowsEachProfileByItsLengthAndItsColumns) {
  using lidar::Format;
  using tests::OusterPacket;
  EXPECT_EQ(name_guessed(OusterPacket{}.bytes()), "Ouster OS, legacy 64");
  EXPECT_EQ(name_guessed(OusterPacket{.format = Format::kOusterRng15, .rows = 128}.bytes()),
            "Ouster OS, RNG15 128");
  EXPECT_EQ(name_guessed(OusterPacket{.format = Format::kOusterRng19, .rows = 32}.bytes()),
            "Ouster OS, RNG19 32");
  EXPECT_EQ(name_guessed(OusterPacket{.columns_per_turn = 2048, .column_ns = 48'828}.bytes()),
            "Ouster OS, legacy 64");
  const auto guessed = guess_unit(OusterPacket{.frame = 77}.bytes());
  ASSERT_TRUE(guessed);
  EXPECT_TRUE(guessed->is_numbered);
  EXPECT_EQ(guessed->info.scan_number, 77U);
  EXPECT_EQ(guessed->ticks_per_turn, 46'080U);
}

TEST(UnitGuess, KnowsEachHesaiByItsHead) {
  EXPECT_EQ(name_guessed(tests::HesaiPacket{}.bytes()), "Hesai Pandar64");
  EXPECT_EQ(name_guessed(tests::HesaiPacket{.is_xt32 = true}.bytes()), "Hesai PandarXT-32");
  EXPECT_FALSE(guess_unit(tests::HesaiPacket{}.bytes())->is_numbered);
}

TEST(UnitGuess, WhatIsNotTheirsIsNone) {
  EXPECT_EQ(name_guessed({}), "none");
  EXPECT_EQ(name_guessed(tests::VelodynePacket{}.bytes()), "none");
  EXPECT_EQ(name_guessed(tests::LuxMessage{.scan_number = 7}.bytes()), "none");
  EXPECT_EQ(name_guessed(std::vector<std::byte>(12'608)), "none");
}

}  // namespace
}  // namespace iog::tools
