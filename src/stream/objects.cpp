#include "stream/objects.hpp"

#include <algorithm>

#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::stream {
namespace {

constexpr std::uint16_t kObjectBytes = 40;

void write_object(const ObjectRecord& object, wire::ByteWriter& out) {
  out.u32_be(object.id);
  out.u8(static_cast<std::uint8_t>(object.state));
  out.u8(object.existence);
  out.u16_be(object.age_frames);
  out.i32_be(object.x_mm);
  out.i32_be(object.y_mm);
  out.u16_be(object.length_cm);
  out.u16_be(object.width_cm);
  out.u16_be(object.heading);
  out.u16_be(object.flags);
  out.i16_be(object.vx_cm_s);
  out.i16_be(object.vy_cm_s);
  for (const std::uint16_t value :
       {object.sigma_v_along_cm_s, object.sigma_v_across_cm_s, object.sigma_along_mm,
        object.sigma_across_mm, object.since_hit_ms, object.since_stopped_10ms}) {
    out.u16_be(value);
  }
}

ObjectRecord read_object(wire::ByteReader& in) {
  ObjectRecord object;
  object.id = in.u32_be();
  object.state = static_cast<ObjectState>(in.u8());
  object.existence = in.u8();
  object.age_frames = in.u16_be();
  object.x_mm = in.i32_be();
  object.y_mm = in.i32_be();
  object.length_cm = in.u16_be();
  object.width_cm = in.u16_be();
  object.heading = in.u16_be();
  object.flags = in.u16_be();
  object.vx_cm_s = in.i16_be();
  object.vy_cm_s = in.i16_be();
  for (std::uint16_t* value :
       {&object.sigma_v_along_cm_s, &object.sigma_v_across_cm_s, &object.sigma_along_mm,
        &object.sigma_across_mm, &object.since_hit_ms, &object.since_stopped_10ms}) {
    *value = in.u16_be();
  }
  return object;
}

bool has_known_state(const ObjectRecord& object) {
  return object.state >= ObjectState::kYoung && object.state <= ObjectState::kStopped;
}

// Only moving objects have a speed. Moving and stopped objects have standard deviations of
// velocity, others do not.
bool has_due_velocity(const ObjectRecord& object) {
  const bool rests = object.vx_cm_s == 0 && object.vy_cm_s == 0;
  const bool has_deviations =
      object.sigma_v_along_cm_s != kNotBelieved && object.sigma_v_across_cm_s != kNotBelieved;
  const bool has_none =
      object.sigma_v_along_cm_s == kNotBelieved && object.sigma_v_across_cm_s == kNotBelieved;
  return (rests || object.state == ObjectState::kMoves) &&
         (object.is_believed() ? has_deviations : has_none);
}

// True if this part can hold `count` objects. Only an empty list has an empty part.
bool can_hold(const ObjectsHeader& header, std::size_t part, std::size_t count) {
  const std::size_t objects = header.objects;
  const std::size_t parts = header.parts;
  if (parts == 0 || parts > kMaxObjectParts || part >= parts || count > kMaxObjectsOfAPart ||
      (objects > 0 && header.time_us == 0)) {
    return false;
  }
  if (parts == 1) {
    return count == objects;
  }
  // Each other part holds 1 to kMaxObjectsOfAPart objects.
  const std::size_t others = parts - 1;
  return count > 0 && objects >= count + others && objects <= count + others * kMaxObjectsOfAPart;
}

}  // namespace

std::size_t write_objects(const ObjectList& list, std::size_t part, std::span<std::byte> buffer) {
  wire::ByteWriter out(buffer);
  out.u16_be(kObjectsHeaderBytes);
  out.u16_be(kObjectBytes);
  out.u16_be(list.count);
  out.u8(static_cast<std::uint8_t>(part));
  out.u8(static_cast<std::uint8_t>(parts_of(list)));
  out.u64_be(list.time_us);
  out.u16_be(list.tracks_refused);
  out.u16_be(list.hits_left);
  out.u32_be(0);
  const std::span<const ObjectRecord> rest = list.all().subspan(part * kMaxObjectsOfAPart);
  for (const ObjectRecord& object : rest.first(std::min(rest.size(), kMaxObjectsOfAPart))) {
    write_object(object, out);
  }
  return out.ok() ? out.written().size() : 0;
}

ReadStatus read_objects(std::span<const std::byte> body, ObjectPart& part) {
  wire::ByteReader in(body);
  const std::size_t header_bytes = in.u16_be();
  const std::size_t object_bytes = in.u16_be();
  part.header.objects = in.u16_be();
  part.part = in.u8();
  part.header.parts = in.u8();
  part.header.time_us = in.u64_be();
  part.header.tracks_refused = in.u16_be();
  part.header.hits_left = in.u16_be();
  if (!in.ok() || body.size() < kObjectsHeaderBytes || body.size() < header_bytes) {
    return ReadStatus::kTooShort;
  }
  if (header_bytes < kObjectsHeaderBytes || object_bytes < kObjectBytes ||
      (body.size() - header_bytes) % object_bytes != 0) {
    return ReadStatus::kInconsistent;
  }
  const std::size_t count = (body.size() - header_bytes) / object_bytes;
  if (!can_hold(part.header, part.part, count)) {
    return ReadStatus::kInconsistent;
  }
  part.count = static_cast<std::uint8_t>(count);
  std::uint32_t id_before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    wire::ByteReader record(body.subspan(header_bytes + i * object_bytes, object_bytes));
    const ObjectRecord object = read_object(record);
    if (object.id <= id_before || !has_known_state(object) || !has_due_velocity(object)) {
      return ReadStatus::kInconsistent;
    }
    id_before = object.id;
    part.records[i] = object;
  }
  return ReadStatus::kOk;
}

}  // namespace iog::stream
