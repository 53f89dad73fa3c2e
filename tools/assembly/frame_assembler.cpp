#include "tools/assembly/frame_assembler.hpp"

#include <array>
#include <utility>

#include "tile_coding/decode.hpp"

namespace iog::tools {
namespace {

// Half of the last messages are enough to trust the channel; a third of them broken is too much.
constexpr protection::Supervision kSupervision{.window = 30,
                                               .init = {.min_ok = 15, .max_errors = 5},
                                               .valid = {.min_ok = 10, .max_errors = 10},
                                               .invalid = {.min_ok = 15, .max_errors = 5}};
static_assert(kSupervision.is_valid());

std::vector<std::byte> copy_of(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

}  // namespace

FrameAssembler::FrameAssembler(FrameHandler on_frame)
    : on_frame_(std::move(on_frame)),
      supervisor_(kSupervision),
      references_(std::make_unique<stream::References>()) {}

void FrameAssembler::take(std::span<const std::byte> datagram) {
  const protection::Received received = receiver_.receive(datagram);
  using protection::SomeIpStatus;
  switch (received.header) {
    case SomeIpStatus::kOk:
      break;
    case SomeIpStatus::kNotOurs:
      ++counts_.not_ours;
      return;
    case SomeIpStatus::kWrongVersion:
      ++counts_.other_version;
      return;
    case SomeIpStatus::kTooShort:
    case SomeIpStatus::kTooLong:
    case SomeIpStatus::kWrongType:
      ++counts_.corrupt;
      return;
  }
  supervisor_.take(received.check);
  if (received.check == protection::CheckStatus::kError) {
    ++counts_.corrupt;
    return;
  }
  take_content(received.content, datagram.size());
}

void FrameAssembler::take_content(std::span<const std::byte> content, std::size_t datagram_bytes) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(content, header, body) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  if (!is_of_this_run(header)) {
    consider_restart(header, content);
    return;
  }
  of_the_past_.clear();
  const SequenceWatch::Arrival arrival = sequences_.arrive(header.sequence);
  if (arrival == SequenceWatch::Arrival::kRepeated) {
    ++counts_.repeated;
    return;
  }
  ++counts_.messages;
  counts_.bytes += datagram_bytes;
  counts_.late += arrival == SequenceWatch::Arrival::kLate ? 1U : 0U;
  WaitingFrame& waiting = frame_of(header);
  if (header.type == stream::MessageType::kTiles) {
    take_tiles(waiting, body);
  } else if (header.type == stream::MessageType::kFrameEnd) {
    take_end(waiting, header, body);
  } else {
    ++counts_.not_understood;
  }
  // The oldest frame goes first; newer ones wait behind it, but not for ever.
  while (!waiting_.empty() &&
         (waiting_.begin()->second.is_complete() || waiting_.size() > kMaxWaiting)) {
    hand_over_first();
  }
}

void FrameAssembler::note_silence() {
  supervisor_.take(protection::CheckStatus::kNoNewData);
  finish();
  references_->forget();
}

void FrameAssembler::finish() {
  while (!waiting_.empty()) {
    hand_over_first();
  }
}

// Frames that have been handed over are the past. A frame has one moment at which it was closed,
// and the next ones are later: a number that fits while the time does not is one of another run.
bool FrameAssembler::is_of_this_run(const stream::Header& header) const {
  if (has_handed_over_ &&
      (header.frame_number < next_frame_ || header.closed_us < last_closed_us_)) {
    return false;
  }
  const auto waiting = waiting_.find(header.frame_number);
  return waiting == waiting_.end() || waiting->second.frame.header.closed_us == header.closed_us;
}

void FrameAssembler::consider_restart(const stream::Header& header,
                                      std::span<const std::byte> content) {
  ++counts_.too_late;
  if (header.sequence <= past_sequence_) {
    of_the_past_.clear();
  }
  past_sequence_ = header.sequence;
  of_the_past_.push_back(copy_of(content));
  if (of_the_past_.size() < kMessagesOfRestart) {
    return;
  }
  start_over();
  counts_.too_late -= kMessagesOfRestart;
  for (const std::vector<std::byte>& first : std::exchange(of_the_past_, {})) {
    take_content(first, protection::kProtectionBytes + first.size());
  }
}

void FrameAssembler::start_over() {
  finish();
  references_->forget();
  ++counts_.restarts;
  sequences_.restart();
  has_handed_over_ = false;
}

FrameAssembler::WaitingFrame& FrameAssembler::frame_of(const stream::Header& header) {
  const auto [place, is_new] = waiting_.try_emplace(header.frame_number);
  if (is_new) {
    place->second.frame.header = header;
  }
  return place->second;
}

void FrameAssembler::take_tiles(WaitingFrame& waiting, std::span<const std::byte> body) {
  stream::TilesHeader header;
  stream::TileRecords records;
  if (stream::read_tiles(body, header, records) != stream::ReadStatus::kOk ||
      waiting.bodies.size() == kMaxBodies) {
    ++counts_.malformed;
    return;
  }
  // The only grid that this receiver can show.
  if (header.geometry != stream::geometry_of_level(0)) {
    ++counts_.not_understood;
    return;
  }
  for (std::size_t tile = header.first_tile; tile < header.end_tile; ++tile) {
    waiting.spoken_of.set(tile);
  }
  waiting.bodies.push_back(copy_of(body));
}

void FrameAssembler::take_end(WaitingFrame& waiting, const stream::Header& header,
                              std::span<const std::byte> body) {
  stream::FrameEnd end;
  if (stream::read_frame_end(body, header.sensor_count, end) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  waiting.frame.header = header;
  waiting.frame.end = end;
  waiting.frame.has_end = true;
}

void FrameAssembler::decode_tiles(WaitingFrame& waiting) {
  GridFrame& frame = waiting.frame;
  TileSet broken;
  for (const std::vector<std::byte>& body : waiting.bodies) {
    stream::TilesHeader header;
    stream::TileRecords records;
    static_cast<void>(stream::read_tiles(body, header, records));  // it was sound when it came
    for (stream::TileRecord record; records.next(record);) {
      if (decode_tile(record, frame)) {
        frame.known_tiles.set(record.tile);
      } else {
        broken.set(record.tile);
      }
    }
  }
  frame.valid_tiles = waiting.spoken_of & ~broken;
  frame.known_tiles &= frame.valid_tiles;
  frame.tiles = static_cast<std::uint32_t>(frame.known_tiles.count());
  counts_.tiles += frame.tiles;
}

bool FrameAssembler::decode_tile(const stream::TileRecord& record, GridFrame& frame) {
  std::array<std::byte, stream::kTileBytes> cells{};
  using tile_coding::DecodeStatus;
  switch (
      tile_coding::decode(record.encoding, record.payload, references_->find(record.tile), cells)) {
    case DecodeStatus::kOk:
      break;
    case DecodeStatus::kUnknownEncoding:
      ++counts_.not_understood;
      return false;
    case DecodeStatus::kMalformed:
      ++counts_.malformed;
      return false;
    case DecodeStatus::kUnknownReference:
      ++counts_.without_reference;
      return false;
  }
  if (stream::stands_by_itself(record.encoding)) {
    references_->keep(record.tile, cells, frame.header.frame_number, record.payload.size());
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    frame.cells[cell_of_tile(record.tile, i)] = static_cast<index::OccupancyIndex>(cells[i]);
  }
  return true;
}

void FrameAssembler::hand_over_first() {
  auto node = waiting_.extract(waiting_.begin());
  if (has_handed_over_) {
    frames_lost_ += node.key() - next_frame_;
  }
  has_handed_over_ = true;
  next_frame_ = node.key() + 1;
  WaitingFrame& waiting = node.mapped();
  last_closed_us_ = waiting.frame.header.closed_us;
  decode_tiles(waiting);
  if (waiting.frame.header.has_evidence()) {
    waiting.frame.evidence_number = evidence_frames_++;
  }
  on_frame_(std::move(waiting.frame));
}

}  // namespace iog::tools
