// The block of a car: each car comes back as it went, and nothing that is damaged is believed.
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <string_view>

#include "car_block/car_block.hpp"
#include "car_block/content.hpp"
#include "car_bytes.hpp"

namespace iog::car_block {
namespace {

using tests::CarBytes;

void expect_equal(const vehicle::Sensor& read, const vehicle::Sensor& made) {
  EXPECT_EQ(read.name, made.name);
  EXPECT_EQ(read.format, made.format);
  EXPECT_EQ(read.azimuths.nearest(700), made.azimuths.nearest(700));
  EXPECT_EQ(read.sines.sine(77), made.sines.sine(77));
  EXPECT_EQ(read.range.inverse(), made.range.inverse());
  EXPECT_EQ(read.precision.divide(1'234'567), made.precision.divide(1'234'567));
  EXPECT_EQ(read.on_car_x.low, made.on_car_x.low);
  EXPECT_EQ(read.on_car_y.high, made.on_car_y.high);
  EXPECT_EQ(read.in_band.low, made.in_band.low);
  EXPECT_EQ(read.layers_share_lines, made.layers_share_lines);
  EXPECT_EQ(read.ground.is_followed(), made.ground.is_followed());
  EXPECT_EQ(read.profile, made.profile);
  EXPECT_EQ(read.unit().corrections.size(), made.unit().corrections.size());
}

TEST(CarBlock, EachCarComesBackAsItIs) {
  for (const vehicles::Car& written : vehicles::cars()) {
    CarBytes bytes(written);
    const Verdict verdict = bytes.read();
    ASSERT_EQ(verdict.refusal, Refusal::kNone) << Words(verdict).view();
    const vehicle::Vehicle& car = bytes.car;
    EXPECT_EQ(car.name, written.vehicle.name);
    EXPECT_EQ(car.id, written.vehicle.id);
    EXPECT_EQ(car.id, identity_of(car));
    EXPECT_EQ(car.has_objects, vehicle::have_classes(car.grids));
    EXPECT_EQ(car.window.assignment, written.vehicle.window.assignment);
    ASSERT_EQ(car.sensors.size(), written.vehicle.sensors.size());
    for (std::size_t i = 0; i < car.sensors.size(); ++i) {
      expect_equal(car.sensors[i], written.vehicle.sensors[i]);
    }
  }
}

// One that follows the ground has another byte and two numbers, and no others change.
TEST(CarBlock, TheGroundComesBackAsItIs) {
  const vehicles::Car& roof = vehicles::car("roof_hdl64e");
  std::vector<vehicle::Sensor> sensors(roof.vehicle.sensors.begin(), roof.vehicle.sensors.end());
  sensors[0].ground = {.low_mm = 250, .top_mm = 2'300};
  vehicles::Car car = roof;
  car.vehicle.sensors = sensors;
  CarBytes bytes(car);
  const Verdict verdict = bytes.read();
  ASSERT_EQ(verdict.refusal, Refusal::kNone) << Words(verdict).view();
  EXPECT_EQ(bytes.car.sensors[0].ground.low_mm, 250);
  EXPECT_EQ(bytes.car.sensors[0].ground.top_mm, 2'300);
  EXPECT_EQ(bytes.car.id, identity_of(car.vehicle));
  EXPECT_NE(bytes.car.id, roof.vehicle.id);
  expect_equal(bytes.car.sensors[0], sensors[0]);
}

// Each of the three that share a byte, with and without the others (docs/spec.md, 8.4).
TEST(CarBlock, WhatSharesAByteComesBackByItself) {
  const vehicles::Car& roof = vehicles::car("roof_vlp16");
  for (unsigned bits = 0; bits < 4; ++bits) {
    std::vector<vehicle::Sensor> sensors(roof.vehicle.sensors.begin(), roof.vehicle.sensors.end());
    sensors[0].ground = {};
    sensors[0].moved = {};
    if ((bits & 1U) != 0) {
      sensors[0].ground = {.low_mm = 250, .top_mm = 2'300};
    }
    if ((bits & 2U) != 0) {
      sensors[0].moved = {.low_mm = 600, .tall_mm = 700};
    }
    vehicles::Car car = roof;
    car.vehicle.sensors = sensors;
    CarBytes bytes(car);
    ASSERT_EQ(bytes.read().refusal, Refusal::kNone) << bits;
    const vehicle::Sensor& read = bytes.car.sensors[0];
    EXPECT_TRUE(read.layers_share_lines) << bits;
    EXPECT_EQ(read.ground.is_followed(), (bits & 1U) != 0);
    EXPECT_EQ(read.moved.are_given(), (bits & 2U) != 0);
    // What is tall counts farther only where a sensor with both keys judges it.
    EXPECT_EQ(bytes.car.window.tall_within,
              bits == 3 ? perception::kTallOverGroundWithin : perception::kTallWithin);
    // On a roof it is higher than what opens ground.
    EXPECT_EQ(bytes.car.window.looks_over_things, (bits & 2U) != 0);
  }
}

TEST(CarBlock, WhatOpensGroundComesBackAsItIs) {
  const vehicles::Car& roof = vehicles::car("roof_vlp16_radar");
  std::vector<vehicle::Sensor> sensors(roof.vehicle.sensors.begin(), roof.vehicle.sensors.end());
  sensors[0].moved = {.low_mm = 600, .tall_mm = 700};
  vehicles::Car car = roof;
  car.vehicle.sensors = sensors;
  EXPECT_FALSE(roof.vehicle.window.is_opened_from_below);
  CarBytes bytes(car);
  const Verdict verdict = bytes.read();
  ASSERT_EQ(verdict.refusal, Refusal::kNone) << Words(verdict).view();
  EXPECT_EQ(bytes.car.sensors[0].moved.low_mm, 600);
  EXPECT_EQ(bytes.car.sensors[0].moved.tall_mm, 700);
  EXPECT_TRUE(bytes.car.window.is_opened_from_below);
  EXPECT_NE(bytes.car.id, roof.vehicle.id);
}

// The tables that are made of the constants are made only of constants within their limits.
TEST(CarBlock, WrongEvidentialConstantsAreRefused) {
  for (const vehicle::Grids grids : {vehicle::Grids::kIndexes, vehicle::Grids::kBoth}) {
    for (const ageing::Accumulation& wrong :
         {ageing::Accumulation{3'000, 500, 65'535}, {0, 500, 15}, {3'000, 0, 15}}) {
      ageing::Tables tables{.decays = ageing::kUsualDecays,
                            .accumulation = wrong,
                            .free = ageing::make_free_masses(0.3),
                            .hit_mass = 111 * 256};
      vehicles::Car car = vehicles::car("reference_car");
      car.vehicle.grids = grids;
      car.vehicle.window.tables = &tables;
      EXPECT_EQ(CarBytes(car).read().refusal, Refusal::kLimit) << wrong.full_ms;
    }
  }
}

TEST(CarBlock, EvidentialConstantsComeBackAsTheyAre) {
  ageing::Tables tables{.decays = ageing::make_decays(0.001, 0.0001),
                        .accumulation = {6'000, 2'000, 10},
                        .free = ageing::make_free_masses(0.2),
                        .hit_mass = 102 * 256};
  tables.gains = ageing::make_gains_table(tables.accumulation, tables.free, tables.hit_mass);
  const vehicles::Car& reference = vehicles::car("reference_car");
  vehicles::Car car = reference;
  car.vehicle.window.tables = &tables;
  CarBytes bytes(car);
  ASSERT_EQ(bytes.read().refusal, Refusal::kNone);
  ASSERT_NE(bytes.car.window.tables, nullptr);
  EXPECT_EQ(*bytes.car.window.tables, tables);
  EXPECT_EQ(bytes.car.window.moved, reference.vehicle.window.moved);
  EXPECT_NE(bytes.car.id, reference.vehicle.id);
}

TEST(CarBlock, TheWindowComesBackAsItIs) {
  const vehicles::Car& reference = vehicles::car("reference_car");
  vehicles::Car car = reference;
  car.vehicle.window.extent = {.columns = 12, .rows = 32};
  CarBytes bytes(car);
  ASSERT_EQ(bytes.read().refusal, Refusal::kNone);
  EXPECT_EQ(bytes.car.window.extent, car.vehicle.window.extent);
  EXPECT_EQ(bytes.car.window.moved, reference.vehicle.window.moved);
  EXPECT_NE(bytes.car.id, reference.vehicle.id);
}

// An image for cars to come says what it takes, and that it has none (docs/spec.md, section 8).
TEST(CarBlock, WithoutACarItIsRefused) {
  const vehicles::Car& car = vehicles::cars()[0];
  for (const auto grids :
       {vehicle::Grids::kIndexes, vehicle::Grids::kClasses, vehicle::Grids::kBoth}) {
    CarBytes bytes(car);
    write_block_without_car(grids, car.network, bytes.writable());
    EXPECT_EQ(read_firmware(bytes.block()), firmware_of(grids));
    EXPECT_TRUE(read_network(bytes.block()));
    EXPECT_EQ(Words(bytes.read()).view(), "description: it is not there");
  }
}

// docs/spec.md 8.3: behind the bits of the subnet; 0 is what it was before there was any service.
TEST(CarBlock, TheNetworkSaysWhichInstanceIsOffered) {
  CarBytes bytes(vehicles::cars()[0]);
  net::Config network = vehicles::cars()[0].network;
  EXPECT_EQ(bytes.at(64 + 16 + 7), std::byte{0}) << "by default none";
  for (const std::uint8_t instance : std::array<std::uint8_t, 3>{0, 1, 255}) {
    network.service_instance = instance;
    write_block(vehicles::cars()[0].vehicle, network, bytes.writable());
    EXPECT_EQ(bytes.at(64 + 16 + 7), std::byte{instance});
    EXPECT_EQ(read_network(bytes.block())->service_instance, instance);
  }
}

// docs/spec.md 8.6: a record behind the firmware's, where a car without a key has zeros.
TEST(CarBlock, TheKeyStandsBehindTheFirmware) {
  CarBytes bytes(vehicles::car("reference_car"));
  EXPECT_FALSE(read_key(bytes.block()));
  for (std::size_t at = 24; at < 64; ++at) {
    EXPECT_EQ(bytes.at(at), std::byte{0}) << at;
  }
  const std::vector<std::byte> before(bytes.block().begin(), bytes.block().end());
  authentication::Key key{};
  key.front() = std::byte{0xA0};
  key.back() = std::byte{0x0B};
  write_key(key, bytes.writable());
  EXPECT_EQ(read_key(bytes.block()), key);
  EXPECT_EQ(bytes.be32(32), 0x494F474BU);
  EXPECT_EQ(bytes.be32(40), 16U);
  EXPECT_EQ(bytes.be32(48), 0xA0000000U);
  EXPECT_EQ(bytes.be32(60), 0x0000000BU);
  for (std::size_t at = 0; at < before.size(); ++at) {
    EXPECT_TRUE(bytes.at(at) == before[at] || (at >= 32 && at < 64)) << at;
  }
  EXPECT_EQ(bytes.read().refusal, Refusal::kNone);
  EXPECT_EQ(bytes.car.id, vehicles::car("reference_car").vehicle.id) << "it is no part of its name";
}

// Else a bit that flips would let everybody in.
TEST(CarBlock, ADamagedKeyIsNotTakenForNone) {
  CarBytes bytes(vehicles::car("reference_car"));
  write_key(authentication::Key{std::byte{1}}, bytes.writable());
  for (std::size_t bit = 8 * 32; bit < 8 * 64; ++bit) {
    const auto flipped = static_cast<std::byte>(1U << bit % 8);
    bytes.at(bit / 8) ^= flipped;
    EXPECT_NE(bytes.read().refusal, Refusal::kNone) << bit;
    bytes.at(bit / 8) ^= flipped;
  }
  bytes.at(50) ^= std::byte{1};
  EXPECT_EQ(Words(bytes.read()).view(), "authentication: it is damaged");
}

TEST(CarBlock, TheNetworkStandsTwice) {
  const net::Config& written = vehicles::cars()[0].network;
  CarBytes bytes(vehicles::cars()[0]);
  const auto is_read = [&] {
    const auto network = read_network(bytes.block());
    return network && network->mac == written.mac && network->address == written.address &&
           network->peer == written.peer && network->peer_port == written.peer_port &&
           network->source_port == written.source_port &&
           network->prefix_bits == written.prefix_bits;
  };
  EXPECT_TRUE(is_read());
  bytes.at(64 + 20) ^= std::byte{1};
  EXPECT_TRUE(is_read());
  EXPECT_EQ(bytes.read().refusal, Refusal::kNone);
  bytes.at(65'472 + 30) ^= std::byte{1};
  EXPECT_FALSE(is_read());
  const Verdict verdict = bytes.read();
  EXPECT_EQ(verdict.refusal, Refusal::kDamaged);
  EXPECT_EQ(Words(verdict).view(), "network: it is damaged");
}

// docs/spec.md, section 8: every field at its place.
TEST(CarBlock, IsWhatTheSpecificationSays) {
  CarBytes bytes(vehicles::car("reference_car"));
  EXPECT_EQ(bytes.be32(0), 0x494F4746U);
  EXPECT_EQ(bytes.be32(4), 0x00010000U);
  EXPECT_EQ(bytes.be32(8), 8U);
  EXPECT_EQ(bytes.be32(12), tests::BitwiseCrc32().add(bytes.block().subspan(16, 8)).value());
  EXPECT_EQ(bytes.be32(16), std::uint32_t{geometry::kCellMm} << 16 | geometry::kCellsPerSide);
  EXPECT_EQ(bytes.be32(20), std::uint32_t{geometry::kResolution} << 16 | 2U << 8);
  EXPECT_EQ(bytes.be32(64), 0x494F474EU);
  EXPECT_EQ(bytes.be32(64 + 8), 20U);
  EXPECT_EQ(bytes.be32(80), 0x02696F67U);
  EXPECT_EQ(bytes.be32(84), 0x00011800U);  // the MAC's end, 24 bits
  EXPECT_EQ(bytes.be32(88), 0x0A00020FU);
  EXPECT_EQ(bytes.be32(92), 0x0A000202U);
  EXPECT_EQ(bytes.be32(96), 15'000U << 16 | 15'001U);
  EXPECT_EQ(bytes.be32(128), 0x494F4743U);
  EXPECT_EQ(bytes.be32(128 + 12), vehicles::car("reference_car").vehicle.id);
  EXPECT_EQ(bytes.be32(65'472), 0x494F474EU);
  const auto name = bytes.content().subspan(6, 14);
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(name.data()), 14),
            std::string_view("reference_car\0", 14));
}

// One bit of each byte that the firmware reads of the car.
TEST(CarBlock, NoDamageIsBelieved) {
  CarBytes bytes(vehicles::car("reference_car"));
  const std::size_t end = CarBytes::kContentAt + bytes.content().size();
  for (std::size_t at = CarBytes::kCarAt; at < end; ++at) {
    const std::byte bit = std::byte{1} << (at % 8);
    bytes.at(at) ^= bit;
    EXPECT_NE(bytes.read().refusal, Refusal::kNone) << at;
    bytes.at(at) ^= bit;
  }
  EXPECT_EQ(bytes.read().refusal, Refusal::kNone);
}

TEST(CarBlock, EachKindOfWrongBlockIsTold) {
  const auto told = [](auto&& change) {
    CarBytes bytes(vehicles::car("reference_car"));
    change(bytes);
    return bytes.read().refusal;
  };
  const auto put = [](CarBytes& bytes, std::size_t offset, int value) {
    bytes.content()[offset] = static_cast<std::byte>(value);
    bytes.mend_crc();
  };
  EXPECT_EQ(told([](CarBytes& bytes) { bytes.at(128) = std::byte{0}; }), Refusal::kNoRecord);
  EXPECT_EQ(told([](CarBytes& bytes) { bytes.at(128 + 5) = std::byte{2}; }),
            Refusal::kWrongVersion);
  EXPECT_EQ(told([](CarBytes& bytes) { bytes.put_be32(128 + 8, 65'472 - 128 - 16 + 1); }),
            Refusal::kWrongLength);
  EXPECT_EQ(told([](CarBytes& bytes) { bytes.at(128 + 7) = std::byte{1}; }), Refusal::kDamaged);
  EXPECT_EQ(told([&](CarBytes& bytes) { put(bytes, 1, 99); }), Refusal::kLimit);
  EXPECT_EQ(told([&](CarBytes& bytes) { put(bytes, 3, 99); }), Refusal::kOtherGrid);
  EXPECT_EQ(told([&](CarBytes& bytes) { put(bytes, 5, 99); }), Refusal::kOtherGrid);
  EXPECT_EQ(told([&](CarBytes& bytes) { put(bytes, 20 + 24, 7); }), Refusal::kNotACar);  // rule
  EXPECT_EQ(told([&](CarBytes& bytes) {
              bytes.put_be32(128 + 8, bytes.be32(128 + 8) + 1);  // a byte behind the last sensor
              bytes.mend_crc();
            }),
            Refusal::kNotACar);
  CarBytes bytes(vehicles::car("reference_car"));
  EXPECT_EQ(bytes.read(vehicle::Grids::kIndexes).refusal, Refusal::kOtherGrids);
}

// A person who reads it can tell what is wrong, and with what.
TEST(CarBlock, EachRefusalHasWordsOfItsOwn) {
  std::set<std::string> told;
  for (const Part part : {Part::kCar, Part::kNetwork, Part::kKey}) {
    for (int refusal = 0; refusal < static_cast<int>(Refusal::kLimit); ++refusal) {
      const Words words({.refusal = static_cast<Refusal>(refusal), .part = part});
      EXPECT_GT(words.view().size(), std::string_view("network: ").size());
      EXPECT_TRUE(told.emplace(words.view()).second) << words.view();
    }
  }
}

// Whatever it is cut to, with a right CRC.
TEST(CarBlock, NoPartOfACarIsACar) {
  CarBytes bytes(vehicles::car("two_lux_parking"));
  const auto length = static_cast<std::uint32_t>(bytes.content().size());
  for (std::uint32_t part = 0; part < length; part += 3) {
    bytes.put_be32(128 + 8, part);
    bytes.mend_crc();
    EXPECT_EQ(bytes.read().refusal, Refusal::kNotACar) << part;
  }
}

}  // namespace
}  // namespace iog::car_block
