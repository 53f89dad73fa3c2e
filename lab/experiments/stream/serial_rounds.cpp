#include "lab/experiments/stream/serial_rounds.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "framing/cobs.hpp"
#include "serial/grid_sender.hpp"
#include "stream/tiles.hpp"

namespace iog::lab {
namespace {

constexpr std::uint64_t kFrameUs = 40'000;
constexpr std::uint64_t kPassUs = 1'000;
constexpr std::uint64_t kFrames = 1500;

// The line and its far end, without loss (hal::SerialPort).
class Line {
 public:
  explicit Line(std::uint32_t bytes_per_second) : bytes_per_second_{bytes_per_second} {}

  [[nodiscard]] std::uint32_t bytes_per_second() const { return bytes_per_second_; }
  [[nodiscard]] std::size_t free_bytes() const { return 4096; }
  void pump() {}
  void write(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
      ++frame_bytes_;
      if (const auto message = decoder_.decode(byte)) {
        take(*message);
        frame_bytes_ = 0;
      }
    }
  }

  void move_to(std::uint64_t now_us) { now_us_ = now_us; }
  [[nodiscard]] const std::map<std::uint16_t, SerialRounds>& rounds() const { return rounds_; }

 private:
  void take(std::span<const std::byte> message) {
    stream::Header header;
    stream::TilesHeader tiles;
    stream::TileRecords records;
    std::span<const std::byte> body;
    if (stream::read_header(message.subspan(protection::kProtectionBytes), header, body) !=
            stream::ReadStatus::kOk ||
        stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk) {
      return;
    }
    const auto [place, is_first] = rounds_.try_emplace(tiles.geometry.cell_mm);
    SerialRounds& rounds = place->second;
    if (is_first) {
      rounds.first_us = now_us_;
    } else if (tiles.first_tile == 0) {
      ++rounds.rounds;
      rounds.last_us = now_us_;
      rounds.bytes = total_bytes_[tiles.geometry.cell_mm];
    }
    total_bytes_[tiles.geometry.cell_mm] += frame_bytes_;
  }

  std::uint32_t bytes_per_second_;
  std::uint64_t now_us_ = 0;
  std::size_t frame_bytes_ = 0;
  std::array<std::byte, protection::kMaxMessageBytes> buffer_{};
  framing::CobsDecoder decoder_{buffer_};
  std::map<std::uint16_t, SerialRounds> rounds_;
  std::map<std::uint16_t, std::uint64_t> total_bytes_;
};

void hand_over(const tools::GridFrame& frame, serial::GridSender& sender) {
  sender.begin_frame(frame.header);
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (frame.known_tiles.test(tile)) {
      sender.take_tile(tile, tools::cells_of_tile(frame.cells, tile));
    }
  }
  sender.end_frame();
}

}  // namespace

std::map<std::uint16_t, SerialRounds> serial_rounds(const std::vector<tools::GridFrame>& frames,
                                                    std::uint32_t bytes_per_second) {
  const auto sender = std::make_unique<serial::GridSender>();
  Line line(bytes_per_second);
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    hand_over(frames[number % frames.size()], *sender);
    for (std::uint64_t us = 0; us < kFrameUs; us += kPassUs) {
      const std::uint64_t now_us = number * kFrameUs + us;
      line.move_to(now_us);
      sender->pump(now_us, line);
    }
  }
  return line.rounds();
}

}  // namespace iog::lab
