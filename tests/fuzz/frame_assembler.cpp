// The assembler of frames on a series of messages.
#include "tools/assembly/frame_assembler.hpp"

#include "law.hpp"

namespace iog::fuzz {
namespace {

// A frame holds a whole grid: more messages would only cost time.
constexpr std::size_t kMaxMessages = 32;

void check(std::span<const std::byte> input) {
  std::uint64_t last = 0;
  bool has_frame = false;
  std::uint64_t restarts = 0;
  tools::FrameAssembler* running = nullptr;
  tools::FrameAssembler assembler([&](tools::GridFrame&& frame) {
    const bool is_same_run = running != nullptr && running->counts().restarts == restarts;
    law(!has_frame || !is_same_run || frame.header.frame_number > last || last > 0xFFFF0000U,
        "frames come in their order");
    has_frame = true;
    last = frame.header.frame_number;
    restarts = running->counts().restarts;
  });
  running = &assembler;
  wire::ByteReader in(input);
  std::size_t messages = 0;
  while (in.remaining() > 0 && messages++ < kMaxMessages) {
    assembler.take(next_piece(in));
  }
  assembler.finish();
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::fuzz::check(iog::fuzz::input_bytes(data, size));
  return 0;
}
