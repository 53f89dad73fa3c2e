// A car that has a key takes signed poses and maps alone; one that has none takes what it always
// did.
#include "app/command_gate.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "app/loop.hpp"
#include "fake_machine.hpp"
#include "fakes/pose_bytes.hpp"
#include "fakes/test_vehicles.hpp"
#include "net/frames.hpp"

namespace iog::app {
namespace {

using authentication::Verdict;
using net::testing::kConfig;
using testing::FakeMachine;

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t kRun = 1;  // of the fake machine
constexpr std::uint32_t kSource = 0x0A00026E;
constexpr std::uint32_t kPeer = kConfig.peer.value;
constexpr std::uint32_t kStranger = 0x0A00024D;
constexpr authentication::Key kKey{std::byte{1}, std::byte{2}};

vehicle::Vehicle car_of(vehicle::Grids grids) {
  vehicle::Vehicle car = tests::ThreeLux::kVehicle;
  car.grids = grids;
  car.poses.source_ipv4 = kSource;
  car.maps.source_ipv4 = kSource;
  return car;
}

Bytes plain_pose() { return tests::PoseBytes().bytes(); }

Bytes plain_chunk() {
  static const Bytes block(3'000);
  map::ChunkEncoder encoder;
  const auto message = encoder.encode(map::chunk_of(5, block, 1));
  return {message.begin(), message.end()};
}

Bytes signed_as(Bytes message, std::uint16_t kind, authentication::Freshness freshness) {
  const authentication::CmacKey key(kKey);
  message.resize(message.size() + authentication::kTrailerBytes);
  authentication::sign(key, kind, freshness, message);
  return message;
}

Bytes signed_pose(std::uint32_t counter, std::uint32_t run = kRun) {
  return signed_as(plain_pose(), 0x8003, {.run = run, .counter = counter});
}

class Gate : public ::testing::Test {
 protected:
  // What the pipeline would see.
  std::optional<Bytes> pass(const Bytes& payload, std::uint16_t port = pose::kPosePort,
                            std::uint32_t from = kSource) {
    const auto passed = gate_.pass({from, port, payload});
    return passed ? std::optional(Bytes(passed->payload.begin(), passed->payload.end()))
                  : std::nullopt;
  }
  [[nodiscard]] std::uint32_t poses(Verdict verdict) const {
    return gate_.counts().kinds[0].verdicts.at(static_cast<std::size_t>(verdict));
  }
  // Without what signs them.
  [[nodiscard]] std::vector<std::uint32_t> counts() const {
    const auto words = std::bit_cast<std::array<std::uint32_t, 10>>(gate_.counts().kinds);
    return {words.begin(), words.end()};
  }

  vehicle::Vehicle car_ = car_of(vehicle::Grids::kBoth);
  CommandGate gate_{SignedCommands{.key = kKey, .vehicle = &car_, .replayer_ipv4 = kPeer}, kRun};
};

TEST_F(Gate, ASignedPoseIsThePoseItWas) {
  EXPECT_EQ(pass(signed_pose(1)), plain_pose());
  EXPECT_EQ(pass(signed_pose(2), pose::kPosePort, kPeer), plain_pose()) << "who may replay signs";
  EXPECT_EQ(poses(Verdict::kAuthentic), 2U);
  EXPECT_EQ(gate_.counts().kinds[0].counter, 2U) << "the last counter";
}

TEST_F(Gate, NoOtherPosePasses) {
  ASSERT_TRUE(pass(signed_pose(5)));
  EXPECT_FALSE(pass(plain_pose()));
  EXPECT_FALSE(pass({}));
  EXPECT_FALSE(pass(signed_pose(5)));
  EXPECT_FALSE(pass(signed_pose(4)));
  EXPECT_FALSE(pass(signed_pose(6, kRun - 1))) << "recorded before a reset";
  EXPECT_FALSE(pass(signed_as(plain_pose(), 0x8004, {.run = kRun, .counter = 6})));
  Bytes moved = signed_pose(6);
  moved[48] ^= std::byte{1};  // x
  EXPECT_FALSE(pass(moved));
  EXPECT_EQ(counts(), (std::vector<std::uint32_t>{1, 2, 2, 3, 5, 0, 0, 0, 0, 0}));
}

TEST_F(Gate, MapsHaveACounterOfTheirOwn) {
  ASSERT_TRUE(pass(signed_pose(9)));
  const Bytes chunk = signed_as(plain_chunk(), 0x8004, {.run = kRun, .counter = 3});
  EXPECT_EQ(pass(chunk, map::kMapPort), plain_chunk());
  EXPECT_FALSE(pass(chunk, map::kMapPort));
  EXPECT_FALSE(pass(plain_chunk(), map::kMapPort));
  EXPECT_EQ(counts(), (std::vector<std::uint32_t>{1, 0, 0, 0, 9, 1, 1, 1, 0, 3}));
}

// The pipeline counts a stranger by his address, before it looks at a byte; no MAC is computed.
TEST_F(Gate, OfAStrangerNothingIsRead) {
  EXPECT_EQ(pass(signed_pose(1), pose::kPosePort, kStranger), Bytes());
  EXPECT_EQ(counts(), std::vector<std::uint32_t>(10));
  pose::Source source(car_.poses, kPeer);
  EXPECT_EQ(source.receive(kStranger, {}, 0), pose::Fate::kStranger);
}

// So that whoever signs knows whose word on run and counters it is.
TEST_F(Gate, ItsCountsAreSigned) {
  ASSERT_TRUE(pass(signed_pose(9)));
  const authentication::CmacKey key(kKey);
  const auto signature = authentication::mac_of_counters(key, 0x8001, kRun, counts());
  EXPECT_EQ(gate_.counts().signature, signature);
}

TEST_F(Gate, ScansPassAsTheyAre) {
  EXPECT_EQ(pass(plain_pose(), 100), plain_pose());
  EXPECT_EQ(counts(), std::vector<std::uint32_t>(10));
}

TEST_F(Gate, WithoutAKeyEverythingPasses) {
  CommandGate open(std::nullopt, kRun);
  EXPECT_FALSE(open.is_on());
  const Bytes pose = plain_pose();
  const auto passed = open.pass({kSource, pose::kPosePort, pose});
  ASSERT_TRUE(passed);
  EXPECT_EQ(passed->payload.data(), pose.data());
}

// Flips one bit of what it remembers after the other: what nobody has signed never gets in.
TEST_F(Gate, NoFlippedBitOpensIt) {
  ASSERT_TRUE(pass(signed_pose(9)));
  const auto bytes = std::as_writable_bytes(std::span(&gate_, 1));
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const auto mask = static_cast<std::byte>(1U << bit % 8);
    const Bytes before(bytes.begin(), bytes.end());
    bytes[bit / 8] ^= mask;
    for (const auto& [command, port] :
         {std::pair{plain_pose(), pose::kPosePort}, {plain_chunk(), map::kMapPort}}) {
      ASSERT_TRUE(pass(command, port).value_or(Bytes()).empty()) << bit;
    }
    std::ranges::copy(before, bytes.begin());
  }
}

// The counter is what lets no command of before in again. Where keys and numbers lie is not asked:
// those bits make another MAC.
TEST(FlippedCounter, LetsNoMessageOfBeforeIn) {
  const authentication::CmacKey key(kKey);
  authentication::Verifier verifier(key, 0x8003, kRun);
  ASSERT_EQ(verifier.verify(signed_pose(9)), Verdict::kAuthentic);
  const auto bytes = std::as_writable_bytes(std::span(&verifier, 1)).subspan(sizeof(void*));
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    for (const std::uint32_t counter : {1U, 8U, 9U}) {
      ASSERT_NE(verifier.verify(signed_pose(counter)), Verdict::kAuthentic) << bit;
    }
    bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
  }
}

// The check of memory finds whatever of the settings has changed (docs/safety.md).
TEST_F(Gate, TheCheckOfMemoryFindsAnotherSetting) {
  FakeMachine machine;
  MachinePlatform<FakeMachine> platform(machine, kConfig, 1,
                                        SignedCommands{.key = kKey, .vehicle = &car_});
  std::vector<health::Region> regions;
  platform.for_each_constant([&](std::span<const std::byte> bytes) {
    regions.push_back({.name = "", .bytes = bytes, .crc = health::crc_of(bytes)});
  });
  const health::MemoryCheck check(regions);
  const Bytes pose = signed_pose(7);
  EXPECT_TRUE(platform.admit(
      {.source = {kSource}, .destination_port = pose::kPosePort, .payload = pose}, 0));
  EXPECT_FALSE(check.look_at_all()) << "what a command changes is none";
  const auto is_there = [&](const auto& wanted) {
    const auto value = std::as_bytes(std::span(&wanted, 1));
    return std::ranges::any_of(regions, [&](const health::Region& region) {
      return std::search(region.bytes.begin(), region.bytes.end(), value.begin(), value.end()) !=
             region.bytes.end();
    });
  };
  EXPECT_TRUE(is_there(kSource));
  EXPECT_TRUE(is_there(kPeer));
  EXPECT_TRUE(is_there(kConfig.address));
  EXPECT_TRUE(is_there(pose::kPosePort));
  EXPECT_TRUE(is_there(map::kMapPort));
}

// It takes no commands, and what has their ports is a sensor's.
TEST_F(Gate, ACarWithoutClassesHasNoDoors) {
  const vehicle::Vehicle car = car_of(vehicle::Grids::kIndexes);
  CommandGate gate(SignedCommands{.key = kKey, .vehicle = &car}, kRun);
  const Bytes pose = plain_pose();
  EXPECT_TRUE(gate.pass({kSource, pose::kPosePort, pose}));
  EXPECT_EQ(gate.counts().kinds[0].verdicts[0], 0U);
}

// docs/spec.md 3.7: at the end, behind those of service discovery, which are there as well.
TEST_F(Gate, ItsCountsAreAmongTheLinkCounters) {
  FakeMachine machine;
  MachinePlatform<FakeMachine> platform(machine, kConfig, 1,
                                        SignedCommands{.key = kKey, .vehicle = &car_});
  const Bytes pose = signed_pose(7);
  const net::Datagram datagram{
      .source = {kSource}, .destination_port = pose::kPosePort, .payload = pose};
  EXPECT_TRUE(platform.admit(datagram, 0));
  EXPECT_FALSE(platform.admit(datagram, 0));
  const Vitals& vitals = platform.vitals({});
  ASSERT_EQ(vitals.link_counter_count, 227U);
  const auto counts = std::span(vitals.link_counters).subspan<215, 5>();
  EXPECT_EQ(std::vector(counts.begin(), counts.end()), (std::vector<std::uint32_t>{1, 0, 1, 0, 7}));
}

}  // namespace
}  // namespace iog::app
