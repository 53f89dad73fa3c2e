#include "tools/frames/frame_assembler.hpp"

#include <algorithm>
#include <utility>

#include "stream/car_refusal.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

// Half of the last messages are enough to trust the channel; a third of them broken is too much.
constexpr protection::Supervision kSupervision{.window = 30,
                                               .init = {.min_ok = 15, .max_errors = 5},
                                               .valid = {.min_ok = 10, .max_errors = 10},
                                               .invalid = {.min_ok = 15, .max_errors = 5}};
static_assert(kSupervision.is_valid());

// What the frame has.
constexpr unsigned contents_of(const stream::Header& header) {
  return header.flags & (stream::kFlagClasses | stream::kFlagNoIndexes | stream::kFlagObjects |
                         stream::kFlagReceptions);
}

}  // namespace

std::string words_of_version(std::uint8_t sent) {
  return "interface version " + std::to_string(sent) + "; this iog reads " +
         std::to_string(stream::kInterfaceVersion);
}

FrameAssembler::FrameAssembler(FrameHandler on_frame)
    : on_frame_(std::move(on_frame)), supervisor_(kSupervision) {}

void FrameAssembler::believe_signed(const authentication::Key& key) {
  signed_ = std::make_unique<SignedStream>(key);
}

void FrameAssembler::take(std::span<const std::byte> datagram) {
  if (!signed_) {
    take_message(datagram);
    return;
  }
  signed_->take(datagram, [this](std::span<const std::byte> message) { take_message(message); });
  count_signed();
}

void FrameAssembler::count_signed() {
  counts_.signatures = signed_->signatures();
  counts_.forged_signatures = signed_->forged_signatures();
  counts_.not_signed = signed_->unsigned_messages();
}

void FrameAssembler::take_message(std::span<const std::byte> datagram) {
  if (is_trusted_) {
    take_content(datagram.subspan(protection::kProtectionBytes));
    return;
  }
  if (SignedStream::claims_to_sign(datagram)) {
    ++counts_.signatures;
    return;
  }
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
      version_sent_ = received.interface_version;
      return;
    case SomeIpStatus::kTooShort:
    case SomeIpStatus::kTooLong:
    case SomeIpStatus::kWrongType:
      ++counts_.corrupt;
      return;
  }
  supervisor_.update(received.check);
  if (received.check == protection::CheckStatus::kError) {
    ++counts_.corrupt;
    return;
  }
  take_content(received.content);
}

void FrameAssembler::take_content(std::span<const std::byte> content) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(content, header, body) != stream::ReadStatus::kOk) {
    ++counts_.malformed;
    return;
  }
  switch (runs_.arrive(header, content)) {
    case RunWatch::Verdict::kNewest:
      take_newest(header, content, body);
      break;
    case RunWatch::Verdict::kReplaces:
      ++counts_.other_run;
      start_over();
      break;
    case RunWatch::Verdict::kUnconfirmed:
    case RunWatch::Verdict::kReplaced:
      ++counts_.other_run;
      break;
  }
}

// It is handed over as far as it has come. Nothing of it stays.
void FrameAssembler::end_run() {
  hand_over_all();
  indexes_.forget();
  classes_.forget();
  shapes_ = {};
  sequences_.restart();
  has_handed_over_ = false;
  car_refusal_.reset();
}

void FrameAssembler::forget() {
  if (signed_) {
    signed_->forget();
  }
  end_run();
  runs_ = {};
}

void FrameAssembler::start_over() {
  end_run();
  ++counts_.restarts;
  for (const std::vector<std::byte>& content : runs_.take_kept()) {
    stream::Header header;
    std::span<const std::byte> body;
    static_cast<void>(stream::read_header(content, header, body));  // it was sound when it came
    --counts_.other_run;
    take_newest(header, content, body);
  }
}

void FrameAssembler::take_newest(const stream::Header& header, std::span<const std::byte> content,
                                 std::span<const std::byte> body) {
  if (header.type == stream::MessageType::kCarRefused) {
    take_refusal(header, body);
    return;
  }
  if (has_handed_over_ && header.frame_number < next_frame_) {
    ++counts_.too_late;
    return;
  }
  const SequenceWatch::Arrival arrival = sequences_.arrive(header.sequence);
  if (arrival == SequenceWatch::Arrival::kRepeated) {
    ++counts_.repeated;
    return;
  }
  const Fate fate = take_body(header, body);
  ++(counts_.*fate);
  if (fate == &MessageCounts::messages) {
    counts_.bytes += protection::kProtectionBytes + content.size();
    counts_.late += arrival == SequenceWatch::Arrival::kLate ? 1U : 0U;
  }
  // The oldest frame goes first; newer ones wait behind it, but not for ever.
  while (!waiting_.empty() &&
         (waiting_.begin()->second.is_complete() || waiting_.size() > kMaxWaiting)) {
    hand_over_first();
  }
}

// It is of no frame.
void FrameAssembler::take_refusal(const stream::Header& header, std::span<const std::byte> body) {
  const std::optional<stream::CarRefusal> refusal = stream::read_car_refusal(body);
  if (!refusal) {
    ++counts_.malformed;
    return;
  }
  const bool is_repeated = sequences_.arrive(header.sequence) == SequenceWatch::Arrival::kRepeated;
  ++(is_repeated ? counts_.repeated : counts_.messages);
  car_refusal_ = printable(std::string(refusal->words));
}

void FrameAssembler::note_silence() {
  supervisor_.update(protection::CheckStatus::kNoNewData);
  hand_over_all();
}

void FrameAssembler::finish() {
  if (signed_) {
    signed_->finish();
    count_signed();
  }
  hand_over_all();
}

void FrameAssembler::hand_over_all() {
  while (!waiting_.empty()) {
    hand_over_first();
  }
}

FrameAssembler::WaitingFrame& FrameAssembler::frame_of(const stream::Header& header) {
  const auto [place, is_new] = waiting_.try_emplace(header.frame_number);
  if (is_new) {
    GridFrame& frame = place->second.frame;
    frame.header = header;
    if (header.has_classes()) {
      frame.classes.emplace();
    }
  }
  return place->second;
}

FrameAssembler::Fate FrameAssembler::take_body(const stream::Header& header,
                                               std::span<const std::byte> body) {
  WaitingFrame& waiting = frame_of(header);
  if (contents_of(header) != contents_of(waiting.frame.header)) {
    return &MessageCounts::malformed;
  }
  switch (header.type) {
    case stream::MessageType::kTiles:
      return take_tiles(waiting, body);
    case stream::MessageType::kFrameEnd:
      return take_end(waiting, header, body);
    case stream::MessageType::kClassEnd:
      return take_class_end(waiting, body);
    case stream::MessageType::kObjects:
      return take_objects(waiting, body);
    case stream::MessageType::kReceptions:
      return take_receptions(waiting, body);
    case stream::MessageType::kCarRefused:
      break;  // of no frame
  }
  return &MessageCounts::not_understood;
}

FrameAssembler::Fate FrameAssembler::take_tiles(WaitingFrame& waiting,
                                                std::span<const std::byte> body) {
  stream::TilesHeader tiles;
  stream::TileRecords records;
  if (stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk) {
    return &MessageCounts::malformed;
  }
  if (stream::extent_of(tiles.geometry)) {
    return take_class_tiles(waiting, tiles, body);
  }
  const std::optional<geometry::Grid> grid = stream::grid_of(tiles.geometry);
  if (!grid) {
    return &MessageCounts::not_understood;
  }
  std::uint16_t& epsilon_e5 = waiting.frame.epsilon_e5;
  const bool agrees = 0 < tiles.epsilon_e5 && tiles.epsilon_e5 < 50'000 &&
                      (epsilon_e5 == 0 || epsilon_e5 == tiles.epsilon_e5);
  if (!agrees || !waiting.frame.header.has_indexes() || !waiting.indexes.take(tiles, *grid, body)) {
    return &MessageCounts::malformed;
  }
  epsilon_e5 = tiles.epsilon_e5;
  return &MessageCounts::messages;
}

FrameAssembler::Fate FrameAssembler::take_class_tiles(WaitingFrame& waiting,
                                                      const stream::TilesHeader& tiles,
                                                      std::span<const std::byte> body) {
  const stream::Geometry& its = tiles.geometry;
  const geometry::Grid grid{.cell_mm = its.cell_mm, .columns = its.width, .rows = its.height};
  const bool is_taken = waiting.agree_on(*tiles.window) && waiting.classes.take(tiles, grid, body);
  return is_taken ? &MessageCounts::messages : &MessageCounts::malformed;
}

FrameAssembler::Fate FrameAssembler::take_class_end(WaitingFrame& waiting,
                                                    std::span<const std::byte> body) {
  stream::ClassEnd end;
  if (stream::read_class_end(body, end) != stream::ReadStatus::kOk ||
      !waiting.agree_on(end.window)) {
    return &MessageCounts::malformed;
  }
  waiting.frame.classes->end = end;
  waiting.frame.classes->has_end = true;
  return &MessageCounts::messages;
}

FrameAssembler::Fate FrameAssembler::take_objects(WaitingFrame& waiting,
                                                  std::span<const std::byte> body) {
  stream::ObjectPart part;
  const bool is_taken = waiting.frame.header.has_objects() &&
                        stream::read_objects(body, part) == stream::ReadStatus::kOk &&
                        waiting.objects.take(part);
  return is_taken ? &MessageCounts::messages : &MessageCounts::malformed;
}

FrameAssembler::Fate FrameAssembler::take_receptions(WaitingFrame& waiting,
                                                     std::span<const std::byte> body) {
  stream::ReceptionPart part;
  const bool is_taken = waiting.frame.header.has_receptions() &&
                        stream::read_receptions(body, part) == stream::ReadStatus::kOk &&
                        waiting.receptions.take(part);
  return is_taken ? &MessageCounts::messages : &MessageCounts::malformed;
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

bool FrameAssembler::WaitingFrame::agree_on(const stream::ClassWindow& window) {
  if (!frame.classes) {
    return false;
  }
  if (!has_window) {
    has_window = true;
    frame.classes->window = window;
  }
  return frame.classes->window == window;
}

void FrameAssembler::decode_indexes(WaitingFrame& waiting) {
  GridFrame& frame = waiting.frame;
  frame.shape = shapes_.indexes = waiting.indexes.grid().value_or(shapes_.indexes);
  const auto tiles =
      waiting.indexes.decode(indexes_, frame.header.frame_number, counts_,
                             [&](const stream::TileRecord& record, const TileBytes& cells) {
                               put_tile(cells, record.tile, frame.cells, frame.shape);
                             });
  shapes_.epsilon_e5 = frame.epsilon_e5 > 0 ? frame.epsilon_e5 : shapes_.epsilon_e5;
  frame.epsilon_e5 = shapes_.epsilon_e5;
  frame.valid_tiles = tiles.valid;
  frame.known_tiles = tiles.known;
  frame.tiles = static_cast<std::uint32_t>(tiles.known.count());
  counts_.tiles += frame.tiles;
}

void FrameAssembler::decode_classes(WaitingFrame& waiting) {
  ClassGrid& classes = *waiting.frame.classes;
  shapes_.classes = waiting.classes.grid().value_or(shapes_.classes);
  const SlotsOfTiles slots = classes.take_shape(shapes_.classes);
  const auto tiles =
      waiting.classes.decode(classes_, waiting.frame.header.frame_number, counts_,
                             [&](const stream::TileRecord& record, const TileBytes& cells) {
                               const std::size_t slot = slots.at(record.tile);
                               put_tile(cells, tile_in_window(classes.window, slot), classes.cells);
                               classes.age_frames.at(slot) = record.age_frames;
                             });
  classes.take_tiles(slots, tiles.valid, tiles.known);
  counts_.class_tiles += tiles.known.count();
}

// Every tile has been decoded, and yet some cell is wrong; nobody knows which.
void FrameAssembler::take_back_if_damaged(GridFrame& frame) {
  frame.is_damaged = !is_trusted_ && frame.header.has_indexes() && frame.is_whole() &&
                     grid_crc_of(frame) != frame.end.grid_crc;
  if (frame.is_damaged) {
    indexes_.forget();
    frame.valid_tiles.reset();
    frame.known_tiles.reset();
    frame.tiles = 0;
    std::ranges::fill(frame.cells, index::kUnknown);
  }
}

void FrameAssembler::take_back_if_damaged(ClassGrid& classes) {
  classes.is_damaged =
      !is_trusted_ && classes.is_whole() && class_crc_of(classes) != classes.end.classes_crc;
  if (classes.is_damaged) {
    classes_.forget();
    classes.valid_tiles.reset();
    classes.known_tiles.reset();
    classes.age_frames.fill(0);
    std::ranges::fill(classes.cells, std::int8_t{0});
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
  decode_indexes(waiting);
  take_back_if_damaged(waiting.frame);
  if (waiting.frame.classes) {
    decode_classes(waiting);
    take_back_if_damaged(*waiting.frame.classes);
  }
  waiting.frame.objects = waiting.objects.list();
  waiting.frame.receptions = waiting.receptions.list();
  if (waiting.frame.header.has_evidence()) {
    waiting.frame.evidence_number = evidence_frames_++;
  }
  on_frame_(std::move(waiting.frame));
}

}  // namespace iog::tools
