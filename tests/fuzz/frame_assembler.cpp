// The assembler of frames on a series of messages. A CRC keeps random bytes out; so the input's
// messages are protected by a sender of ours, unless they say that they come as they are.
#include "tools/frames/frame_assembler.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "law.hpp"
#include "tools/frames/live_classes.hpp"
#include "tools/frames/live_grid.hpp"

namespace iog::fuzz {
namespace {

// A frame holds a whole grid: more messages would only cost time.
constexpr std::size_t kMaxMessages = 32;

std::vector<std::byte> protected_message(protection::Sender& sender,
                                         std::span<const std::byte> content) {
  const std::size_t bytes = std::min(content.size(), protection::kMaxContentBytes);
  std::vector<std::byte> message(protection::kProtectionBytes);
  message.insert(message.end(), content.begin(),
                 content.begin() + static_cast<std::ptrdiff_t>(bytes));
  sender.protect(message);
  return message;
}

void check_frame(const tools::GridFrame& frame) {
  law((frame.known_tiles & ~frame.valid_tiles).none(), "what is known is valid");
  law(frame.tiles == frame.known_tiles.count(), "tiles are counted");
  law(frame.classes.has_value() == frame.header.has_classes(), "classes are announced");
  if (frame.classes) {
    law((frame.classes->known_tiles & ~frame.classes->valid_tiles).none(), "likewise of classes");
  }
  law(!frame.objects || frame.header.has_objects(), "objects are announced");
  if (frame.objects) {
    law(frame.objects->has_place() || frame.objects->count == 0, "they have a time");
    law(std::ranges::adjacent_find(frame.objects->all(), std::ranges::greater_equal{},
                                   &stream::ObjectRecord::id) == frame.objects->all().end(),
        "their ids rise");
  }
}

// What is shown of the world is in the window, and as old as the frames since it came.
void check_live(const tools::LiveClasses& live) {
  law(live.stale_tiles() <= geometry::kTileCount, "tiles have an age");
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    const auto age = live.age_of(slot);
    law(age.has_value() == live.decided_ago(slot).has_value(), "and nothing else has");
    law(!age || live.window().has_value(), "what is shown has a place");
    law(!age || stream::are_class_bytes(std::as_bytes(std::span(live.tile(slot)))),
        "and is classes");
    law(!age || *live.decided_ago(slot) >= std::min<std::uint32_t>(*age, 255),
        "nothing is decided after it came");
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  std::uint64_t last = 0;
  bool has_frame = false;
  std::uint64_t restarts = 0;
  tools::LiveGrid live;
  tools::LiveClasses live_classes;
  tools::FrameAssembler* running = nullptr;
  tools::FrameAssembler assembler([&](tools::GridFrame&& frame) {
    const bool is_same_run = running != nullptr && running->counts().restarts == restarts;
    law(!has_frame || !is_same_run || frame.header.frame_number > last || last > 0xFFFF0000U,
        "frames come in their order");
    check_frame(frame);
    live.take(frame);
    live_classes.take(frame);
    check_live(live_classes);
    has_frame = true;
    last = frame.header.frame_number;
    restarts = running->counts().restarts;
  });
  running = &assembler;
  protection::Sender sender(stream::kNetworkChannel);
  wire::ByteReader in(input);
  std::size_t messages = 0;
  while (in.remaining() > 0 && messages++ < kMaxMessages) {
    const std::span<const std::byte> piece = next_piece(in);
    if (!piece.empty() && piece.front() == std::byte{0xFF}) {
      assembler.take(piece.subspan(1));
    } else if (piece.size() == 1) {
      assembler.note_silence();
    } else {
      assembler.take(protected_message(sender, piece));
    }
  }
  assembler.finish();
  law(live.stale_tiles() <= geometry::kTileCount, "tiles have an age");
}

}  // namespace iog::fuzz
