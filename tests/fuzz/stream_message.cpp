// The readers of the messages that carry a grid.
#include <array>

#include "law.hpp"
#include "stream/message.hpp"

namespace iog::fuzz {
namespace {

using Buffer = std::array<std::byte, stream::kMaxMessageBytes>;

// The fields that we know, written again and read again, are written the same once more.
template <typename Part, typename Read, typename Write>
void check_again(const Part& part, Read read, Write write) {
  Buffer once{};
  const std::size_t bytes = write(part, once);
  law(bytes > 0, "what was read can be written");
  Part again{};
  law(read(std::span(once).first(bytes), again), "and read");
  Buffer twice{};
  law(write(again, twice) == bytes && once == twice, "and is the same");
}

void check_message(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(message, header, body) != stream::ReadStatus::kOk) {
    return;
  }
  law(body.size() + stream::kHeaderBytes <= message.size(), "the body is behind the header");
  stream::TileHeader tile;
  std::span<const std::byte> payload;
  if (stream::read_tile(body, tile, payload) == stream::ReadStatus::kOk) {
    law(payload.size() == tile.payload_bytes &&
            payload.size() + stream::kTileHeaderBytes == body.size(),
        "a tile is as long as it says");
  }
  check_again(
      header,
      [](std::span<const std::byte> bytes, stream::Header& part) {
        std::span<const std::byte> rest;
        return stream::read_header(bytes, part, rest) == stream::ReadStatus::kOk;
      },
      [](const stream::Header& part, Buffer& buffer) {
        return stream::write_header(part, buffer);
      });
  stream::FrameEnd end;
  if (header.sensor_count <= vehicle::kMaxSensors &&
      stream::read_frame_end(body, header.sensor_count, end) == stream::ReadStatus::kOk) {
    check_again(
        end,
        [&](std::span<const std::byte> bytes, stream::FrameEnd& part) {
          return stream::read_frame_end(bytes, header.sensor_count, part) ==
                 stream::ReadStatus::kOk;
        },
        [&](const stream::FrameEnd& part, Buffer& buffer) {
          return stream::write_frame_end(part, header.sensor_count, buffer);
        });
  }
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::fuzz::check_message(iog::fuzz::input_bytes(data, size));
  return 0;
}
