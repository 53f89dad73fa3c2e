#include "tools/receive/frame_assembler.hpp"

#include <algorithm>
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
    consider_restart(header, content, &MessageCounts::too_late);
    return;
  }
  const SequenceWatch::Arrival arrival = sequences_.arrive(header.sequence);
  if (arrival == SequenceWatch::Arrival::kRepeated) {
    take_repeated(header, content);
    return;
  }
  forget_the_past();
  const Fate fate = take_body(header, body);
  ++(counts_.*fate);
  if (fate == &MessageCounts::messages) {
    counts_.bytes += datagram_bytes;
    counts_.late += arrival == SequenceWatch::Arrival::kLate ? 1U : 0U;
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

// One frame cannot have been closed at two times.
bool FrameAssembler::is_of_another_run(const stream::Header& header) const {
  const auto past = past_frames_.find(header.frame_number);
  const auto waiting = waiting_.find(header.frame_number);
  return (past != past_frames_.end() && past->second.closed_us != header.closed_us) ||
         (waiting != waiting_.end() && waiting->second.frame.header.closed_us != header.closed_us);
}

// Numbers of messages rise from frame to frame. So this one is of another run than whoever had the
// number before, if its frame is a new one.
void FrameAssembler::take_repeated(const stream::Header& header,
                                   std::span<const std::byte> content) {
  if (waiting_.contains(header.frame_number)) {
    ++counts_.repeated;
    return;
  }
  if (waiting_.empty() || waiting_.rbegin()->first < header.frame_number) {
    references_->forget();
  }
  consider_restart(header, content, &MessageCounts::repeated);
}

// What is certainly of another run makes it doubtful whose frames the next ones will refer to.
void FrameAssembler::consider_restart(const stream::Header& header,
                                      std::span<const std::byte> content, Fate fate) {
  ++(counts_.*fate);
  if (is_of_another_run(header)) {
    references_->forget();
  }
  const auto [place, is_new] = of_the_past_[header.frame_number].try_emplace(header.sequence);
  if (!is_new) {
    return;
  }
  place->second = {.content = copy_of(content), .fate = fate};
  ++past_messages_;
  if (past_messages_ >= kMessagesOfRestart && of_the_past_.size() >= kFramesOfRestart) {
    start_over();
  } else if (past_messages_ == kFramesOfRestart * kMaxBodies) {
    forget_the_past();  // more than there can be in so few frames
  }
}

void FrameAssembler::forget_the_past() {
  of_the_past_.clear();
  past_messages_ = 0;
}

void FrameAssembler::start_over() {
  finish();
  references_->forget();
  ++counts_.restarts;
  sequences_.restart();
  has_handed_over_ = false;
  past_frames_.clear();
  const auto first_frames = std::exchange(of_the_past_, {});
  past_messages_ = 0;
  for (const auto& [frame, messages] : first_frames) {
    for (const auto& [sequence, message] : messages) {
      --(counts_.*message.fate);
      take_content(message.content, protection::kProtectionBytes + message.content.size());
    }
  }
}

FrameAssembler::WaitingFrame& FrameAssembler::frame_of(const stream::Header& header) {
  const auto [place, is_new] = waiting_.try_emplace(header.frame_number);
  if (is_new) {
    place->second.frame.header = header;
  }
  return place->second;
}

FrameAssembler::Fate FrameAssembler::take_body(const stream::Header& header,
                                               std::span<const std::byte> body) {
  WaitingFrame& waiting = frame_of(header);
  switch (header.type) {
    case stream::MessageType::kTiles:
      return take_tiles(waiting, header, body);
    case stream::MessageType::kFrameEnd:
      return take_end(waiting, header, body);
  }
  return &MessageCounts::not_understood;
}

std::optional<std::uint32_t> FrameAssembler::end_sequence_of(std::uint32_t frame_number) const {
  if (const auto waiting = waiting_.find(frame_number); waiting != waiting_.end()) {
    const GridFrame& frame = waiting->second.frame;
    return frame.has_end ? std::optional(frame.header.sequence) : std::nullopt;
  }
  const auto past = past_frames_.find(frame_number);
  return past != past_frames_.end() ? past->second.end_sequence : std::nullopt;
}

// Of the message with a frame's first tile: between the end of the frame before and it there is
// nothing that could be missing, unless that frame is of another run.
bool FrameAssembler::follows_the_frame_before(const stream::Header& header) const {
  const auto end = end_sequence_of(header.frame_number - 1);
  return !end || (header.sequence > *end && !sequences_.is_missing(*end + 1, header.sequence)) ||
         *end == 0xFFFFFFFF;
}

FrameAssembler::Fate FrameAssembler::take_tiles(WaitingFrame& waiting, const stream::Header& header,
                                                std::span<const std::byte> body) {
  stream::TilesHeader tiles;
  stream::TileRecords records;
  if (stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk ||
      waiting.bodies.size() == kMaxBodies) {
    return &MessageCounts::malformed;
  }
  // The only grid that this receiver can show.
  if (tiles.geometry != stream::geometry_of_level(0)) {
    return &MessageCounts::not_understood;
  }
  if (tiles.first_tile == 0 && !follows_the_frame_before(header)) {
    references_->forget();
  }
  for (std::size_t tile = tiles.first_tile; tile < tiles.end_tile; ++tile) {
    waiting.spoken_of.set(tile);
  }
  waiting.bodies.push_back(copy_of(body));
  return &MessageCounts::messages;
}

FrameAssembler::Fate FrameAssembler::take_end(WaitingFrame& waiting, const stream::Header& header,
                                              std::span<const std::byte> body) {
  stream::FrameEnd end;
  if (stream::read_frame_end(body, header.sensor_count, end) != stream::ReadStatus::kOk) {
    return &MessageCounts::malformed;
  }
  waiting.frame.header = header;
  waiting.frame.end = end;
  waiting.frame.has_end = true;
  return &MessageCounts::messages;
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
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  using tile_coding::DecodeStatus;
  switch (tile_coding::decode(record.encoding, record.payload,
                              reference_of(record.tile, frame.header.frame_number), cells)) {
    case DecodeStatus::kOk:
      break;
    case DecodeStatus::kUnknownEncoding:
      ++counts_.tiles_not_understood;
      return false;
    case DecodeStatus::kMalformed:
      ++counts_.tiles_malformed;
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

// No sender refers to an older frame; one of that number is of another run.
std::optional<tile_coding::Reference> FrameAssembler::reference_of(
    std::size_t tile, std::uint32_t frame_number) const {
  const auto kept = references_->find(tile);
  const bool is_too_old = kept && frame_number - kept->frame_number > stream::kMaxReferenceAge;
  return is_too_old ? std::nullopt : kept;
}

// Every tile has been decoded, and yet some cell is wrong; nobody knows which.
void FrameAssembler::take_back_if_damaged(GridFrame& frame) {
  frame.is_damaged = frame.is_whole() && grid_crc_of(frame) != frame.end.grid_crc;
  if (frame.is_damaged) {
    references_->forget();
    frame.valid_tiles.reset();
    frame.known_tiles.reset();
    frame.tiles = 0;
    std::ranges::fill(frame.cells, index::kUnknown);
  }
}

// As many as the next frame may refer to.
void FrameAssembler::note_past(const GridFrame& frame) {
  PastFrame& past = past_frames_[frame.header.frame_number];
  past.closed_us = last_closed_us_ = frame.header.closed_us;
  past.end_sequence = frame.has_end ? std::optional(frame.header.sequence) : std::nullopt;
  if (past_frames_.size() > stream::kMaxReferenceAge) {
    past_frames_.erase(past_frames_.begin());
  }
}

void FrameAssembler::hand_over_first() {
  auto node = waiting_.extract(waiting_.begin());
  if (has_handed_over_) {
    frames_lost_ += node.key() - next_frame_;
  }
  has_handed_over_ = true;
  next_frame_ = node.key() + 1;
  WaitingFrame& waiting = node.mapped();
  note_past(waiting.frame);
  decode_tiles(waiting);
  take_back_if_damaged(waiting.frame);
  if (waiting.frame.header.has_evidence()) {
    waiting.frame.evidence_number = evidence_frames_++;
  }
  on_frame_(std::move(waiting.frame));
}

}  // namespace iog::tools
