// Writes a few good inputs for each target into <folder>/<target>/: where the fuzzing begins.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "fakes/lux_message.hpp"
#include "fakes/vlp16_packet.hpp"
#include "geometry/grid.hpp"
#include "net/frames.hpp"
#include "pose/message.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/mcap/writer.hpp"

namespace iog::fuzz {
namespace {

using Bytes = std::vector<std::byte>;

class Seeds {
 public:
  explicit Seeds(std::filesystem::path root) : root_{std::move(root)} {}

  [[nodiscard]] std::string next_path(const std::string& target) {
    const std::filesystem::path folder = root_ / target;
    std::filesystem::create_directories(folder);
    return folder / std::to_string(count_++);
  }

  void add(const std::string& target, const Bytes& bytes) {
    std::ofstream file(next_path(target), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path root_;
  int count_ = 0;
};

Bytes piece_of(const Bytes& bytes) {
  Bytes piece{static_cast<std::byte>(bytes.size() >> 8), static_cast<std::byte>(bytes.size())};
  piece.insert(piece.end(), bytes.begin(), bytes.end());
  return piece;
}

Bytes joined(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

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

void add_lidar_seeds(Seeds& seeds) {
  const Bytes lux = lux_message(12);
  seeds.add("ibeo_lux", joined(piece_of(lux_message(0)), lux));
  seeds.add("lux_recording", joined(lux, lux_message(3)));
  for (const int mode : {0x37, 0x38, 0x39}) {
    tests::Vlp16Packet packet{.first_azimuth = 35'900, .mode = mode};
    packet.ranges.fill({1, 2, 3, 500, 60'000});
    seeds.add("velodyne_vlp16", joined(piece_of(packet.bytes()), packet.bytes()));
  }
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
  tools::PcapWriter writer(seeds.next_path("capture_file"));
  writer.write({.time_us = 1, .source = {1, 2}, .destination = {3, 4}, .payload = Bytes(20)});
  writer.write({.time_us = 2, .source = {1, 2}, .destination = {3, 4}, .payload = Bytes(7)});
  writer.finish();
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

Bytes end_content(std::uint32_t frame_number) {
  Bytes head(stream::kHeaderBytes);
  static_cast<void>(stream::write_header({.type = stream::MessageType::kFrameEnd,
                                          .sequence = 2 * frame_number + 1,
                                          .frame_number = frame_number,
                                          .closed_us = frame_number,
                                          .sensor_count = 2},
                                         head));
  Bytes end(400);
  end.resize(stream::write_frame_end({.tiles_sent = 1, .link_counter_count = 3}, 2, end));
  return joined(std::move(head), end);
}

Bytes tiles_content(std::uint32_t frame_number, tile_coding::Encoding encoding,
                    const Bytes& payload) {
  stream::TilesWriter writer;
  writer.begin_grid({.frame_number = frame_number, .closed_us = frame_number},
                    stream::geometry_of_level(0));
  static_cast<void>(writer.append(3, encoding, payload));
  const auto message = writer.finish(geometry::kTileCount, 2 * frame_number);
  return {message.begin() + protection::kProtectionBytes, message.end()};
}

// Two frames of one tile, the second against the first.
void add_stream_seeds(Seeds& seeds) {
  const Bytes raw(1024, std::byte{3});
  Bytes since{std::byte{0}, std::byte{0}, std::byte{0}, std::byte{5}};
  since.insert(since.end(), {std::byte{0}, std::byte{0x00}, std::byte{0x20}, std::byte{0x00}});
  const Bytes first = tiles_content(5, tile_coding::Encoding::kRaw, raw);
  const Bytes second = tiles_content(6, tile_coding::Encoding::kChangedSince, since);
  seeds.add("stream_message", first);
  seeds.add("stream_message", end_content(5));
  seeds.add("serial_line",
            joined(piece_of(first), piece_of(tiles_content(6, tile_coding::Encoding::kRaw, raw))));
  seeds.add("frame_assembler", joined(joined(piece_of(first), piece_of(end_content(5))),
                                      joined(piece_of(second), piece_of(end_content(6)))));
}

void add_tile_seeds(Seeds& seeds) {
  static tile_coding::Encoder encoder;
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells.at(i) = static_cast<std::byte>(i / 40 % 6);
  }
  const std::array<std::byte, tile_coding::kTileBytes> before{};
  const tile_coding::Reference reference{.cells = before, .frame_number = 0};
  for (std::size_t i = 0; i < tile_coding::kEncodingCount; ++i) {
    std::array<std::byte, tile_coding::kTileBytes> payload{};
    const auto result =
        encoder.encode_as(static_cast<tile_coding::Encoding>(i), cells, reference, payload);
    Bytes seed{static_cast<std::byte>(result.encoding), std::byte{0}};
    seed.insert(seed.end(), payload.begin(),
                payload.begin() + static_cast<std::ptrdiff_t>(result.bytes));
    seeds.add("tile_decoder", seed);
  }
  Bytes drawing;
  for (int i = 0; i < 100; ++i) {
    drawing.push_back(static_cast<std::byte>(i * 37));
  }
  seeds.add("tile_encoder", drawing);
  seeds.add("protected_link", drawing);
  seeds.add("cobs", drawing);
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

}  // namespace
}  // namespace iog::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "seeds: expected a folder\n";
    return 2;
  }
  iog::fuzz::Seeds seeds(argv[1]);
  iog::fuzz::add_lidar_seeds(seeds);
  iog::fuzz::add_network_seeds(seeds);
  iog::fuzz::add_mcap_seeds(seeds);
  iog::fuzz::add_stream_seeds(seeds);
  iog::fuzz::add_tile_seeds(seeds);
  iog::fuzz::add_pose_seeds(seeds);
  return 0;
}
