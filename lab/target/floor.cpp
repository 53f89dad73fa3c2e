// floor: what the memory alone asks for. Whatever a core computes, the lines of 32 bytes of the
// grid in which a frame leaves something known must be read and written once to get there, read
// once more to be sent, and written once to be cleared. This image does that and nothing else, with
// the lines of a capture's frames: what it takes in QEMU's cost model (lab/target/measure_a9) no
// core on these caches goes below that has the grid in memory.
//
//   floor <capture> <frames>
//
// First the frames are fused to see which lines they leave, then the marked passes go over those.
// One frame more goes before, to warm up. A pass reads a list of its lines, two bytes each.
#include <arm_neon.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>

#include "capture.hpp"
#include "fused_frames.hpp"
#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "playback.hpp"
#include "protection/protected_message.hpp"
#include "require/require.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kLineBytes = 32;  // TRM of the Cortex-A9 and of PL310
constexpr geometry::Cell kLastCell = geometry::cell_of(geometry::kCellCount - 1);
constexpr std::size_t kLines = grid::offset_of(kLastCell, grid::kBlockStride) / kLineBytes + 1;
constexpr std::size_t kLinesOfMessage = protection::kMaxMessageBytes / kLineBytes;
using LineNumber = std::uint16_t;
static_assert(kLines - 1 <= std::numeric_limits<LineNumber>::max());

// The frames' lines, one frame after the other.
class LineList {
 public:
  void add(LineNumber line) {
    require(count_ < lines_.size());
    lines_[count_++] = line;
  }
  void end_frame() {
    require(frames_ + 1 < ends_.size());
    ends_[++frames_] = count_;
  }
  [[nodiscard]] std::size_t frames() const { return frames_; }
  [[nodiscard]] std::span<const LineNumber> of_frame(std::size_t frame) const {
    return std::span(lines_).subspan(ends_[frame], ends_[frame + 1] - ends_[frame]);
  }

 private:
  std::array<LineNumber, 40 * kLines> lines_{};
  std::array<std::size_t, 128> ends_{};
  std::size_t count_ = 0;
  std::size_t frames_ = 0;
};

// Looks at the grid of each frame, as it is stored.
class TouchedLines {
 public:
  TouchedLines(Capture& capture, LineList& list, std::size_t frames)
      : capture_(capture), list_(list), frames_(frames) {}

  void look_at(const grid::BlockGrid& frame) {
    if (!note_lines(frame)) {
      return;
    }
    list_.end_frame();
    if (list_.frames() == frames_) {
      capture_.close();
    }
  }

 private:
  // False if nothing is known.
  bool note_lines(const grid::BlockGrid& frame) {
    static std::array<bool, kLines> known;
    known.fill(false);
    for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
      const geometry::Cell cell = geometry::cell_of(number);
      if (frame.at(cell) != index::kUnknown) {
        known[grid::offset_of(cell, grid::kBlockStride) / kLineBytes] = true;
      }
    }
    for (std::size_t line = 0; line < kLines; ++line) {
      if (known[line]) {
        list_.add(static_cast<LineNumber>(line));
      }
    }
    return std::ranges::find(known, true) != known.end();
  }

  Capture& capture_;
  LineList& list_;
  std::size_t frames_;
};

class Passes {
 public:
  // Reads and writes each line once.
  [[gnu::noinline]] void fuse(std::span<const LineNumber> lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::int8_t* const line = at(lines[i]);
      ask_for(lines, i);
      vst1q_s8(line, vqsubq_s8(vld1q_s8(line), vdupq_n_s8(14)));
      vst1q_s8(line + 16, vqsubq_s8(vld1q_s8(line + 16), vdupq_n_s8(14)));
    }
  }

  // Copies each line once, message by message, into the one that the network sends next.
  [[gnu::noinline]] void send(std::span<const LineNumber> lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::int8_t* const line = at(lines[i]);
      ask_for(lines, i);
      std::int8_t* const target = &message_[i % kLinesOfMessage * kLineBytes];
      vst1q_s8(target, vld1q_s8(line));
      vst1q_s8(target + 16, vld1q_s8(line + 16));
    }
  }

  // Writes each line once.
  [[gnu::noinline]] void clear(std::span<const LineNumber> lines) {
    for (const LineNumber number : lines) {
      std::int8_t* const line = at(number);
      vst1q_s8(line, vdupq_n_s8(0));
      vst1q_s8(line + 16, vdupq_n_s8(0));
    }
  }

 private:
  // Some lines ahead, so that none is waited for that the fill buffers could have had by now.
  void ask_for(std::span<const LineNumber> lines, std::size_t i) {
    constexpr std::size_t kAhead = 8;
    __builtin_prefetch(at(lines[std::min(i + kAhead, lines.size() - 1)]), 1);
  }

  std::int8_t* at(LineNumber number) { return &lines_[std::size_t{number} * kLineBytes]; }

  alignas(64) std::array<std::int8_t, kLines * kLineBytes> lines_{};
  alignas(64) std::array<std::int8_t, kLinesOfMessage * kLineBytes> message_{};
};

std::size_t pass_over(const LineList& list, Passes& passes) {
  std::size_t lines = 0;
  for (std::size_t frame = 0; frame < list.frames(); ++frame) {
    passes.fuse(list.of_frame(frame));
    passes.send(list.of_frame(frame));
    passes.clear(list.of_frame(frame));
    if (frame == 0) {
      a9_model::forget_so_far();
    } else {
      lines += list.of_frame(frame).size();
    }
  }
  return lines;
}

int run(const char* path, std::size_t frames) {
  static InstructionCounter counter;
  static Capture capture;
  static LineList list;
  static TouchedLines touched(capture, list, 1 + frames);
  static Passes passes;
  counter.start();
  if (!capture.open(path)) {
    std::printf("floor: %s cannot be read as a pcap of Ethernet frames\n", path);
    return 1;
  }
  const auto look = [](const grid::BlockGrid& frame) { touched.look_at(frame); };
  static FusedFrames fused(vehicles::cars()[0].vehicle, look);
  play(capture, vehicles::cars()[0].vehicle, counter, fused);
  if (list.frames() < 1 + frames) {
    std::puts("floor: the capture has not so many frames");
    return 1;
  }
  const std::size_t lines = pass_over(list, passes);
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf("floor frames=%u lines=%u\n", frames, lines);
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  constexpr std::size_t kMostFrames = 30;
  const std::size_t frames = argc == 3 ? iog::lab::number_in(argv[2], kMostFrames) : 0;
  if (frames == 0) {
    // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
    std::printf("floor: expected a capture and 1 to %u frames\n", kMostFrames);
    return 2;
  }
  return iog::lab::run(argv[1], frames);
}
