#include "tools/receive/object_statistics.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "protection/protected_message.hpp"
#include "stream/crc32.hpp"
#include "stream/objects.hpp"
#include "tools/program/hexadecimal.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::array<std::string_view, 4> kStateNames{"young", "standing", "moving", "stopped"};

}  // namespace

std::uint32_t crc_of(const stream::ObjectList& list) {
  if (list.count == 0) {
    return 0;
  }
  stream::Crc32 crc;
  std::array<std::byte, protection::kMaxMessageBytes> body{};
  wire::store_be64(std::span(body).first<8>(), list.time_us);
  crc.update(std::span(body).first<8>());
  for (std::size_t part = 0; part < stream::parts_of(list); ++part) {
    const std::size_t bytes = stream::write_objects(list, part, body);
    crc.update(std::span(body).first(bytes).subspan(stream::kObjectsHeaderBytes));
  }
  return crc.value();
}

void ObjectStatistics::add(const GridFrame& frame) {
  if (!frame.header.has_objects()) {
    return;
  }
  ++frames_;
  incomplete_ += frame.objects ? 0U : 1U;
  not_known_ += frame.objects && !frame.objects->has_place() ? 1U : 0U;
  const stream::ObjectList list = frame.objects.value_or(stream::ObjectList{});
  std::size_t moving = 0;
  for (const stream::ObjectRecord& object : list.all()) {
    ++by_state_.at(static_cast<std::size_t>(object.state) - 1);
    if (object.state == stream::ObjectState::kMoves) {
      ++moving;
      moved_.insert(object.id);
    }
  }
  most_moving_ = std::max(most_moving_, moving);
  tracks_refused_ += list.tracks_refused;
  hits_left_ += list.hits_left;
  if (frame.header.has_evidence()) {
    hash_.add(crc_of(list));
  }
}

Facts ObjectStatistics::facts() const {
  Facts facts;
  add_fact(facts, "object_frames", frames_);
  add_fact(facts, "object_frames_incomplete", incomplete_);
  add_fact(facts, "object_frames_without_place", not_known_);
  add_facts(facts, "objects_", by_state_, kStateNames);
  add_fact(facts, "objects_moving_most", most_moving_);
  add_fact(facts, "objects_that_moved", moved_.size());
  add_fact(facts, "objects_refused", tracks_refused_);
  add_fact(facts, "objects_hits_left", hits_left_);
  facts.emplace_back("object_run_hash", hex(run_hash()));
  return facts;
}

std::string ObjectStatistics::table() const {
  if (frames_ == 0) {
    return {};
  }
  return row("object frames", std::to_string(frames_)) +
         row_if(incomplete_ + not_known_ > 0, "objects not known",
                counted(incomplete_, "frame|frames incomplete, ") + std::to_string(not_known_) +
                    " without a place") +
         row("objects, all frames", list_of(by_state_, kStateNames)) +
         row("objects that moved", std::to_string(moved_.size()) + ", at most " +
                                       std::to_string(most_moving_) + " in a frame") +
         row_if(tracks_refused_ + hits_left_ > 0, "objects without room",
                std::to_string(tracks_refused_) + ", and " + counted(hits_left_, "hit|hits")) +
         row("object run hash", hex(run_hash()));
}

}  // namespace iog::tools
