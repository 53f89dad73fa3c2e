// Writes a few good inputs for each target into <folder>/<target>/: where the fuzzing begins.
#include "seeds.hpp"

#include <array>
#include <iostream>
#include <span>

#include "car_block/content.hpp"
#include "discovery/bytes.hpp"
#include "fakes/any_packet.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "fakes/real_ars548_list.hpp"
#include "fakes/reference_block.hpp"
#include "pose/message.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/mcap/writer.hpp"
#include "vehicles/cars.hpp"

namespace iog::fuzz {
namespace {

Bytes lux_message(int points) {
  tests::LuxMessage message;
  for (int i = 0; i < points; ++i) {
    message.points.push_back({.layer = i % 4,
                              .echo = i / 4 % 3,
                              .flags = i % 8,
                              .angle_ticks = 1000 - 16 * i,
                              .range_cm = 100 * i});
  }
  return message.bytes();
}

// As packet.cpp reads it.
Bytes packets_of(lidar::Format format, int mode, const Bytes& before, const Bytes& packet) {
  const Bytes head{static_cast<std::byte>(format), static_cast<std::byte>(mode)};
  return joined(head, joined(piece_of(before), packet));
}

void add_packet_seeds(Seeds& seeds) {
  tests::Random random(7);
  lidar::for_each_format(
      [&]<typename Decoder>(lidar::Format format, std::type_identity<Decoder> /*which*/) {
        for (const auto& [mode, rows] : {std::pair(4, 4U), std::pair(136, 64U)}) {  // 1024x10
          for (int i = 0; i < 3; ++i) {
            const Bytes before = tests::sound_packet<Decoder>(random, rows);
            const Bytes packet = tests::sound_packet<Decoder>(random, rows);
            seeds.add("packet", packets_of(format, mode, before, packet));
          }
        }
      });
  const Bytes list = tests::real_ars548_list();
  seeds.add("packet", packets_of(lidar::kFormat<lidar::ContinentalArs548>, 11, {},
                                 Bytes(list.begin() + 36, list.begin() + 101 + 44 * 44)));
  const Bytes lux = lux_message(12);
  seeds.add("packet", packets_of(lidar::kFormat<lidar::IbeoLux>, 0, lux_message(0), lux));
  seeds.add("scan_stream", joined({std::byte{50}}, joined(lux, lux_message(3))));
  seeds.add("lux_recording", joined(lux, lux_message(3)));
}

void add_network_seeds(Seeds& seeds) {
  namespace frames = net::testing;
  for (const std::byte flag : {std::byte{0}, std::byte{1}}) {
    Bytes all;
    for (const frames::Frame& frame :
         {frames::linux_arp_reply(), frames::linux_udp_even(), frames::linux_ping(),
          frames::linux_ping_reply(), frames::velodyne_broadcast(), frames::linux_last_fragment(),
          frames::linux_arp_request()}) {
      all = joined(joined(std::move(all), {flag}), piece_of(frame));
    }
    seeds.add("network_host", all);
  }
  seeds.add("discovery", joined({std::byte{17}}, piece_of(discovery::testing::scapy_subscribe())));
  tools::PcapWriter writer(seeds.next_path("capture_file"));
  writer.write({.time_us = 1, .source = {1, 2}, .destination = {3, 4}, .payload = Bytes(20)});
  writer.write({.time_us = 2, .source = {1, 2}, .destination = {3, 4}, .payload = Bytes(7)});
  writer.finish();
}

// A piece as reassembly.cpp reads it: of datagram 0 of the first sender, 5 ms after the one before.
Bytes fragment_of(bool has_more, std::size_t offset_bytes, std::size_t bytes) {
  const Bytes head{has_more ? std::byte{0x80} : std::byte{0}, std::byte{10}, std::byte{0},
                   static_cast<std::byte>(offset_bytes / 8)};
  return joined(head, piece_of(Bytes(bytes, static_cast<std::byte>(offset_bytes))));
}

// A datagram of three pieces: in order, backwards, with one twice, with two that overlap.
void add_reassembly_seeds(Seeds& seeds) {
  const Bytes first = fragment_of(true, 0, 64);
  const Bytes second = fragment_of(true, 64, 64);
  const Bytes last = fragment_of(false, 128, 13);
  seeds.add("reassembly", joined(joined(first, second), last));
  seeds.add("reassembly", joined(joined(last, second), first));
  seeds.add("reassembly", joined(joined(joined(first, first), last), second));
  seeds.add("reassembly", joined(joined(first, fragment_of(true, 32, 64)), last));
}

void add_mcap_seeds(Seeds& seeds) {
  using tools::mcap::Compression;
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    tools::mcap::Writer writer(seeds.next_path("mcap_file"), "ros2", compression);
    const std::uint16_t schema = writer.add_schema({"a/msg/B", "ros2msg", "uint8 c"});
    const std::uint16_t channel = writer.add_channel({schema, "/d", "cdr", {{"e", "f"}}});
    for (std::uint64_t second = 1; second < 4; ++second) {
      writer.write(channel, {.log_ns = second * 1'000'000'000}, Bytes(10));
    }
    writer.finish("g", {{"h", "i"}});
  }
}

// Every car that the build knows, as a block and as its file.
void add_car_seeds(Seeds& seeds) {
  for (const vehicles::Car& car : vehicles::cars()) {
    Bytes content;
    car_block::write_content(car.vehicle,
                             [&](std::uint8_t byte) { content.push_back(std::byte{byte}); });
    seeds.add("car_block", content);
  }
  for (const char* const folder : {"/vehicles", "/tests/host/vehicles"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(IOG_SOURCE_DIR + std::string(folder))) {
      if (entry.path().extension() == ".toml") {
        std::filesystem::copy_file(entry.path(), seeds.next_path("car_file"),
                                   std::filesystem::copy_options::overwrite_existing);
      }
    }
  }
}

void add_tile_seeds(Seeds& seeds) {
  static tile_coding::Encoder encoder;
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells.at(i) = static_cast<std::byte>(i / 40 % 6);
  }
  const std::array<std::byte, tile_coding::kTileBytes> before{};
  for (const auto& reference :
       {std::optional<tile_coding::Reference>(),
        std::optional(tile_coding::Reference{.cells = before, .frame_number = 3})}) {
    std::array<std::byte, tile_coding::kTileBytes> payload{};
    const auto result = encoder.encode(cells, 5, reference, payload);
    Bytes seed{static_cast<std::byte>(result.encoding), std::byte{5}, std::byte{3}};
    seed.insert(seed.end(), payload.begin(),
                payload.begin() + static_cast<std::ptrdiff_t>(result.bytes));
    seeds.add("tile_decoder", seed);
  }
  Bytes drawing;
  for (int i = 0; i < 100; ++i) {
    drawing.push_back(static_cast<std::byte>(i * 37));
  }
  for (const char* const name :
       {"tile_encoder", "protected_link", "cobs", "secured_message", "signed_stream"}) {
    seeds.add(name, drawing);
  }
}

// Driving on, message after message and slice after slice; and one message as its bytes.
void add_pose_seeds(Seeds& seeds) {
  Bytes drive;
  for (int i = 0; i < 40; ++i) {
    const auto off = static_cast<std::byte>(i == 20 ? 96 : 2 * i + 1);
    drive = joined(std::move(drive), {std::byte{6}, std::byte{0x09}, std::byte{0xC4}, off});
    drive = joined(std::move(drive), {std::byte{5}, std::byte{0xDB}, static_cast<std::byte>(i)});
  }
  seeds.add("pose_source", drive);
  const auto message = pose::Encoder().encode({.run = 1, .clock_us = 5, .sigma = {1, 1}});
  const Bytes piece = piece_of({message.begin(), message.end()});
  seeds.add("pose_source", joined({std::byte{0}}, piece));
}

Bytes bytes_of_block(const tests::ReferenceBlock& block) {
  const auto bytes = block.bytes();
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

// Three features, one of them with a hole and in several buckets.
void add_map_seeds(Seeds& seeds) {
  tests::ReferenceBlock block;
  seeds.add("map_block", joined({std::byte{1}, std::byte{1}}, bytes_of_block(block)));
  block.features = {
      {map::Kind::kBuilding,
       {{{-3'000, 0}, {-2'000, 0}, {-2'000, 900}}, {{-2'900, 1}, {-2'100, 1}, {-2'100, 90}}}},
      {map::Kind::kRoad, {{{-5'000, -4'000}, {5'000, -4'000}, {4'500, 4'000}}}},
      {map::Kind::kBuilding, {{{0, 0}, {1'000, 0}, {1'000, 900}, {0, 900}}}}};
  seeds.add("map_block", joined({std::byte{1}, std::byte{9}}, bytes_of_block(block)));
  seeds.add("map_block", joined({std::byte{8}, std::byte{255}}, bytes_of_block(block)));
}

// A block of two chunks, backwards and with one twice, frames, and once more after it.
void add_delivery_seeds(Seeds& seeds) {
  Bytes steps;
  for (const int step : {5, 1, 5, 1, 3, 0xFF, 0xFF, 5, 0, 4, 4, 5, 0}) {
    steps.push_back(static_cast<std::byte>(step));
  }
  seeds.add("map_delivery", steps);
}

// Turns with bins at the limits of the rule, and of any returns.
void add_ground_seeds(Seeds& seeds) {
  tests::Random random(1);
  for (const std::int32_t bin_mm : {1'024, 2'048}) {
    Bytes bytes{static_cast<std::byte>(bin_mm == 2'048)};
    for (const tests::Turn& turn :
         {tests::turn_at_limits(random, bin_mm), tests::turn_beside(random, bin_mm),
          tests::any_turn(random, 100)}) {
      Bytes returns;
      for (const tests::Return& its : turn) {
        for (const int value : {its.sector, its.along_mm >> 12, its.along_mm >> 4, its.z_mm >> 8,
                                its.z_mm, random.between(0, 1)}) {
          returns.push_back(static_cast<std::byte>(value));
        }
      }
      bytes = joined(bytes, piece_of(returns));
    }
    seeds.add("ground", bytes);
  }
}

}  // namespace
}  // namespace iog::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "seeds: expected a folder\n";
    return 2;
  }
  iog::fuzz::Seeds seeds(argv[1]);
  iog::fuzz::add_car_seeds(seeds);
  iog::fuzz::add_ground_seeds(seeds);
  iog::fuzz::add_packet_seeds(seeds);
  iog::fuzz::add_network_seeds(seeds);
  iog::fuzz::add_mcap_seeds(seeds);
  iog::fuzz::add_stream_seeds(seeds);
  iog::fuzz::add_tile_seeds(seeds);
  iog::fuzz::add_pose_seeds(seeds);
  iog::fuzz::add_reassembly_seeds(seeds);
  iog::fuzz::add_delivery_seeds(seeds);
  iog::fuzz::add_map_seeds(seeds);
  return 0;
}
