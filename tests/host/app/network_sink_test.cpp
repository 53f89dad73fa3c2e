// Tiles become messages, on a fake platform.
#include "app/network_sink.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/fake_platform.hpp"
#include "fakes/random.hpp"

namespace iog::app {
namespace {

using tests::FakePlatform;

// Only a raw tile at the end of a message lends the message its CRC.
TEST(NetworkSink, MessagesAreSoundWhereverTheirRawTilesLie) {
  using Cells = std::array<std::byte, tile_coding::kTileBytes>;
  tests::Random random(83);
  Cells plain{};
  plain[40] = std::byte{5};
  Cells noise{};
  for (std::byte& cell : noise) {
    cell = static_cast<std::byte>(random.between(1, 127));
  }
  FakePlatform platform;
  const auto sink = std::make_unique<NetworkSink<FakePlatform>>(platform, Coding::kShortest);
  const std::vector<std::vector<const Cells*>> frames{
      {&plain, &noise, &plain}, {&plain, &noise}, {&noise}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sink->begin_frame({.frame_number = static_cast<std::uint32_t>(100 * i)});
    for (std::size_t tile = 0; tile < frames[i].size(); ++tile) {
      sink->take_tile(tile, *frames[i][tile]);
    }
    sink->end_frame();
  }
  ASSERT_EQ(platform.frames.size(), frames.size());
  EXPECT_EQ(platform.tile_messages(), 3);
  EXPECT_EQ(platform.unreadable(), 0);
}

}  // namespace
}  // namespace iog::app
