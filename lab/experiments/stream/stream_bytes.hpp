// What the stream of a drive weighs, by encoding.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tile_coding/encode.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {

// Sums over the frames with evidence.
struct StreamBytes {
  std::uint64_t frames = 0;
  std::uint64_t tiles = 0;     // in which something is known
  std::uint64_t messages = 0;  // of these frames, their ends among them
  std::uint64_t bytes = 0;     // in these messages, all headers included
  // As they are sent: how many tiles by each encoding, and the bytes of their payloads.
  std::array<std::uint64_t, tile_coding::kEncodingCount> sent_tiles{};
  std::array<std::uint64_t, tile_coding::kEncodingCount> sent_bytes{};
  std::uint64_t bytes_alone = 0;  // if each tile were sent by itself
};

// Feeds the target with datagrams, one after the other.
using Feed = std::function<void(const std::function<void(const tools::CapturedDatagram&)>&)>;

// Fuses what the feed gives and weighs what the target would send of it.
[[nodiscard]] StreamBytes weigh_stream(const tools::CatalogueEntry& car, const Feed& feed);

// Every message that the target would send of it.
[[nodiscard]] std::vector<std::vector<std::byte>> messages_of(const tools::CatalogueEntry& car,
                                                              const Feed& feed);

// The feeds: a simulated drive of the car, and a recording. UsageError if it cannot be read.
[[nodiscard]] Feed feed_of_drive(const tools::CatalogueEntry& car, std::string_view scene,
                                 std::uint64_t seed, std::uint32_t seconds);
[[nodiscard]] Feed feed_of_recording(const std::string& pcap);

}  // namespace iog::lab
