// The reader of clients/c on a series of messages, protected as those of the assembler of frames.
#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "iogrid.h"
#include "law.hpp"
#include "protection/protected_message.hpp"
#include "stream/channel.hpp"
#include "wire/byte_order.hpp"

namespace iog::fuzz {
namespace {

constexpr std::size_t kMaxMessages = 32;

void check_grid(const iogrid_grid& grid) {
  static constexpr std::array<std::uint8_t, IOGRID_CELLS> kNothing{};
  law(grid.tiles <= IOGRID_TILES, "a grid is no larger than its memory");
  for (std::size_t tile = 0; tile < IOGRID_TILES; ++tile) {
    law(grid.is_lost[tile] == 0 ||
            std::memcmp(grid.cells[tile], kNothing.data(), kNothing.size()) == 0,
        "what is lost is unknown");
  }
}

// All of a list, in order, and a speed only of what moves.
void check_objects(const iogrid_receiver& reader) {
  static std::array<iogrid_object, IOGRID_OBJECTS> all;
  const int count = iogrid_objects(&reader, all.data(), IOGRID_OBJECTS);
  law(count <= IOGRID_OBJECTS && (count < 0 || reader.has_objects != 0), "objects have room");
  law(reader.is_whole == 0 || reader.has_objects == 0 ||
          iogrid_are_objects_complete(&reader.objects) != 0,
      "what is whole has all of them");
  for (int i = 0; i < count; ++i) {
    const iogrid_object& object = all.at(static_cast<std::size_t>(i));
    law(object.id > (i == 0 ? 0 : all.at(static_cast<std::size_t>(i) - 1).id), "ids rise");
    law(object.state == IOGRID_MOVES || (object.vx_cm_s == 0 && object.vy_cm_s == 0),
        "only what moves has a speed");
    std::int32_t x_mm = 0;
    std::int32_t y_mm = 0;
    std::uint32_t sigma_mm = 0;
    const int is_told =
        iogrid_object_at(&object, object.time_us + object.id, &x_mm, &y_mm, &sigma_mm);
    law(is_told == 0 || object.state >= IOGRID_MOVES, "and a place later");
  }
}

void check_frame(const iogrid_receiver& reader) {
  check_objects(reader);
  check_grid(reader.indexes);
  check_grid(reader.classes);
  const bool is_free = iogrid_is_free(&reader, 1, 2, -1, 1) != 0;
  law(!is_free || reader.has_pose != 0, "nothing is free where nobody knows where it is");
}

void take(iogrid_receiver& reader, std::span<const std::byte> message) {
  iogrid_result result = IOGRID_NONE;
  while ((result = iogrid_take(&reader, message.data(), message.size())) == IOGRID_FRAME_AGAIN) {
    check_frame(reader);
  }
  if (result == IOGRID_FRAME) {
    law(reader.indexes.has_end != 0, "a frame that is complete has an end");
    check_frame(reader);
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  static iogrid_receiver reader;  // 4 MiB
  iogrid_init(&reader);
  protection::Sender sender(stream::kNetworkChannel);
  std::uint32_t sequence = 0;  // as many as the sender has protected
  wire::ByteReader in(input);
  for (std::size_t i = 0; in.remaining() > 0 && i < kMaxMessages; ++i) {
    const std::span<const std::byte> piece = next_piece(in);
    if (!piece.empty() && piece.front() == std::byte{0xFF}) {
      take(reader, piece.subspan(1));
      continue;
    }
    std::vector<std::byte> message(protection::kProtectionBytes);
    const std::size_t bytes = std::min(piece.size(), protection::kMaxContentBytes);
    message.insert(message.end(), piece.begin(),
                   piece.begin() + static_cast<std::ptrdiff_t>(bytes));
    // The counter is the low half of the sequence number, or the message is refused.
    if (bytes >= 8) {
      wire::store_be32(std::span(message).subspan<protection::kProtectionBytes + 4, 4>(), sequence);
    }
    sender.protect(message);
    ++sequence;
    take(reader, message);
  }
  if (iogrid_close(&reader) != 0) {
    check_frame(reader);
  }
}

}  // namespace iog::fuzz
