// Why a block is refused that somebody has written with a right CRC, and in which words.
#include <gtest/gtest.h>
#include <string>
#include <string_view>

#include "car_block/car_block.hpp"
#include "car_block/content.hpp"
#include "car_bytes.hpp"
#include "changed_car.hpp"

namespace iog::car_block {
namespace {

using tests::CarBytes;
using tests::Changed;

std::string words_of(CarBytes& bytes) { return std::string(Words(bytes.read()).view()); }

// Of a car of which something is changed before it is written.
template <typename Change>
std::string words_with(Change&& change, std::string_view name = "reference_car") {
  vehicles::Car car = vehicles::car(name);
  Changed changed(car);
  change(changed);
  car.vehicle = changed.car;
  car.network = changed.network;
  CarBytes bytes(car);
  return words_of(bytes);
}

// The limits in words are those of docs/vehicles.md.
TEST(CarRefusal, ALimitIsToldWithItsFieldAndWhatIsAllowed) {
  EXPECT_EQ(words_with([](Changed& c) { c.car.frame_period_us = 9'999; }),
            "description: it breaks a limit: frame_period_us: allowed is 10000 ... 1000000");
  EXPECT_EQ(words_with([](Changed& c) { c.sensors[3].latency_us = 1'000'001; }),
            "description: it breaks a limit: sensors[3].latency_us: allowed is at most 1000000");
  EXPECT_EQ(words_with([](Changed& c) { c.sensors[0].max_points_per_scan = 383; }, "roof_vlp16"),
            "description: it breaks a limit: sensors[0].max_points_per_scan: allowed is at least "
            "384: the points of a packet, of a LUX those of a direction");
}

// Its CRC is right, but no host is there; so who is refused could not say so.
TEST(CarRefusal, ANetworkThatCannotBeIsDamaged) {
  EXPECT_EQ(words_with([](Changed& c) { c.network.peer = net::ipv4(11, 0, 2, 2); }),
            "network: it is damaged");
  EXPECT_EQ(words_with([](Changed& c) { c.network.mac.octets[0] = 1; }), "network: it is damaged");
}

// AES-CMAC with another length of key would be another gate; docs/spec.md, 8.6: 16 bytes.
TEST(CarRefusal, AKeyOfAnotherLengthIsNone) {
  CarBytes bytes(vehicles::car("reference_car"));
  write_key(authentication::Key{std::byte{1}}, bytes.writable());
  for (const std::uint32_t length : {0U, 15U}) {
    bytes.put_be32(32 + 8, length);
    bytes.put_be32(32 + 12, tests::BitwiseCrc32().add(bytes.block().subspan(48, length)).value());
    EXPECT_EQ(bytes.read().refusal, Refusal::kWrongLength) << length;
    EXPECT_EQ(bytes.read().part, Part::kKey);
    EXPECT_FALSE(read_key(bytes.block()));
  }
}

// docs/spec.md, 8.2: there are grids 0, 1 and 2.
TEST(CarRefusal, AFirmwareOfUnknownGridsIsNone) {
  CarBytes bytes(vehicles::car("reference_car"));
  EXPECT_TRUE(read_firmware(bytes.block()));
  bytes.at(16 + 6) = std::byte{3};
  bytes.put_be32(12, tests::BitwiseCrc32().add(bytes.block().subspan(16, 8)).value());
  EXPECT_FALSE(read_firmware(bytes.block()));
  bytes.at(16 + 6) = std::byte{2};
  EXPECT_FALSE(read_firmware(bytes.block())) << "with a wrong CRC";
}

std::size_t place_of_be32(CarBytes& bytes, std::uint32_t first, std::uint32_t second) {
  for (std::size_t at = CarBytes::kContentAt;
       at + 8 <= CarBytes::kContentAt + bytes.content().size(); ++at) {
    if (bytes.be32(at) == first && bytes.be32(at + 4) == second) {
      return at;
    }
  }
  return 0;
}

// docs/vehicles.md: 256 ... 16384 in powers of two. What does not turn has a step for each tick.
TEST(CarRefusal, StepsOfATurnArePowersOfTwo) {
  const vehicles::Car& car = vehicles::car("roof_vlp16");
  const vehicle::AzimuthSteps& azimuths = car.vehicle.sensors[0].azimuths;
  CarBytes bytes(car);
  const std::size_t place =
      place_of_be32(bytes, azimuths.ticks_per_turn(), azimuths.steps_per_turn());
  ASSERT_NE(place, 0U);
  const auto refusal_of_steps = [&](std::uint32_t steps) {
    bytes.put_be32(place + 4, steps);
    bytes.mend_crc();
    return bytes.read().refusal;
  };
  for (std::uint32_t steps = 2; steps < 1U << 20; steps *= 2) {
    EXPECT_EQ(refusal_of_steps(steps) == Refusal::kNotACar, steps < 256 || steps > 16'384) << steps;
    EXPECT_EQ(refusal_of_steps(steps + steps / 2), Refusal::kNotACar) << steps;
  }
  EXPECT_EQ(refusal_of_steps(0), Refusal::kNotACar);
  bytes.put_be32(place, azimuths.ticks_per_turn() + 1);
  EXPECT_EQ(refusal_of_steps(azimuths.steps_per_turn()), Refusal::kNotACar);
}

// The place of the byte of grids, behind the name (docs/spec.md, 8.4).
std::size_t place_of_grids(const vehicles::Car& car) {
  return 6 + car.vehicle.name.size() + 1 + 24 + 2 + 4;
}

TEST(CarRefusal, OnlyWithClassesAreThingsNotFollowed) {
  for (const std::string_view name : {"reference_car", "roof_vlp16"}) {
    const vehicles::Car& car = vehicles::car(name);
    CarBytes bytes(car);
    std::byte& grids = bytes.content()[place_of_grids(car)];
    ASSERT_EQ(grids, static_cast<std::byte>(car.vehicle.grids));
    for (const int bits : {3, 4, 7, 8}) {  // 4: without classes nothing is followed anyway
      grids = static_cast<std::byte>(bits);
      bytes.mend_crc();
      EXPECT_EQ(bytes.read().refusal, Refusal::kNotACar) << bits;
    }
    if (vehicle::have_classes(car.vehicle.grids)) {
      grids = static_cast<std::byte>(static_cast<int>(car.vehicle.grids) + 4);
      bytes.mend_crc();
      EXPECT_EQ(bytes.read().refusal, Refusal::kNone);
      EXPECT_FALSE(bytes.car.has_objects);
    }
  }
}

// A truth is 0 or 1 (docs/spec.md, 8.4): whether the clock is that of the poses, and whether the
// unit is calibrated.
TEST(CarRefusal, ATruthIsZeroOrOne) {
  const vehicles::Car& car = vehicles::car("roof_vlp16");
  const vehicle::Sensor& sensor = car.vehicle.sensors[0];
  CarBytes bytes(car);
  const std::size_t place =
      place_of_be32(bytes, sensor.azimuths.ticks_per_turn(), sensor.azimuths.steps_per_turn()) + 8 +
      16 + 6;
  for (const int truth : {0, 1}) {
    bytes.at(place) = static_cast<std::byte>(truth);
    bytes.mend_crc();
    EXPECT_EQ(bytes.read().refusal, Refusal::kNone);
    EXPECT_EQ(bytes.car.sensors[0].is_synchronised, truth == 1);
  }
  for (const int truth : {2, 255}) {
    bytes.at(place) = static_cast<std::byte>(truth);
    bytes.mend_crc();
    EXPECT_EQ(bytes.read().refusal, Refusal::kNotACar) << truth;
  }
}

// The firmware has two tables of masses. A third would be an estimator that nobody has measured.
TEST(CarRefusal, MassesAreThoseThatTheFirmwareKnows) {
  const vehicles::Car& car = vehicles::car("reference_car");
  const std::size_t place = place_of_grids(car) + 1 + 7 + 6 + 7;
  for (const evidence::Assignment* masses : {static_cast<const evidence::Assignment*>(nullptr),
                                             &evidence::kReinforced, &evidence::kIsopignistic}) {
    vehicles::Car changed = car;
    changed.vehicle.window.assignment = masses;
    CarBytes bytes(changed);
    EXPECT_EQ(bytes.content()[place], masses == nullptr ? std::byte{0} : std::byte{1});
    ASSERT_EQ(bytes.read().refusal, Refusal::kNone);
    EXPECT_EQ(bytes.car.window.assignment, masses);
    if (masses != nullptr) {
      bytes.content()[place + 1 + 2 * 7] ^= std::byte{1};
      bytes.mend_crc();
      EXPECT_EQ(bytes.read().refusal, Refusal::kNotACar);
    }
  }
}

}  // namespace
}  // namespace iog::car_block
