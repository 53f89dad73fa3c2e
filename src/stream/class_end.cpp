#include "stream/class_end.hpp"

#include <algorithm>

#include "pose/wire_format.hpp"

namespace iog::stream {
namespace {

constexpr std::uint8_t kSliceRecordBytes = 24;
constexpr std::uint8_t kCauseRecordBytes = 16;

void write_slice(const SliceRecord& slice, wire::ByteWriter& out) {
  out.u64_be(slice.middle_us);
  pose::write(slice.pose, out);
  pose::write(slice.sigma, out);
}

SliceRecord read_slice(wire::ByteReader& in) {
  SliceRecord slice;
  slice.middle_us = in.u64_be();
  slice.pose = pose::read_pose(in);
  slice.sigma = pose::read_sigma(in);
  return slice;
}

CauseRecord read_cause(wire::ByteReader& in) {
  CauseRecord cause;
  cause.slices = in.u32_be();
  cause.began.times = in.u32_be();
  cause.began.since_us = in.u64_be();
  return cause;
}

// Reads `count` records of `bytes` bytes each into `records`. Skips surplus records, and the bytes
// of a record beyond the first `known` ones.
template <typename Record>
void read_records(std::size_t count, std::size_t bytes, std::size_t known,
                  std::span<Record> records, Record (*read)(wire::ByteReader&),
                  wire::ByteReader& in) {
  for (std::size_t i = 0; i < count; ++i) {
    const Record record = read(in);
    in.skip(bytes - known);
    if (i < records.size()) {
      records[i] = record;
    }
  }
}

}  // namespace

std::size_t write_class_end(const ClassEnd& end, std::span<std::byte> buffer) {
  if (buffer.size() < kClassWindowBytes) {
    return 0;
  }
  write_class_window(end.window, buffer.first<kClassWindowBytes>());
  wire::ByteWriter out(buffer.subspan(kClassWindowBytes));
  for (const std::uint32_t value :
       {end.tiles_sent, end.tiles_lost, end.classes_crc, end.packets_placed, end.packets_not_placed,
        end.slices_over_budget, end.groups_fused, end.groups_left, end.groups_refreshed}) {
    out.u32_be(value);
  }
  out.u8(pose::kFateCount);
  out.u8(pose::kCauseCount);
  out.u8(kCauseRecordBytes);
  out.u8(end.slice_count);
  out.u8(kSliceRecordBytes);
  out.zeros(3);
  for (const std::uint32_t messages : end.pose_fates) {
    out.u32_be(messages);
  }
  for (const CauseRecord& cause : end.causes) {
    out.u32_be(cause.slices);
    out.u32_be(cause.began.times);
    out.u64_be(cause.began.since_us);
  }
  for (std::size_t i = 0; i < end.slice_count; ++i) {
    write_slice(end.slices[i], out);
  }
  if (!out.ok()) {
    return 0;
  }
  const std::size_t bytes = kClassWindowBytes + out.written().size();
  const std::size_t map_bytes = write_map_state(end.map, buffer.subspan(bytes));
  return map_bytes == 0 ? 0 : bytes + map_bytes;
}

ReadStatus read_class_end(std::span<const std::byte> body, ClassEnd& end) {
  wire::ByteReader in(body);
  if (!read_class_window(in, end.window)) {
    return ReadStatus::kTooShort;
  }
  for (std::uint32_t* value :
       {&end.tiles_sent, &end.tiles_lost, &end.classes_crc, &end.packets_placed,
        &end.packets_not_placed, &end.slices_over_budget, &end.groups_fused, &end.groups_left,
        &end.groups_refreshed}) {
    *value = in.u32_be();
  }
  const std::size_t fates = in.u8();
  const std::size_t causes = in.u8();
  const std::size_t cause_bytes = in.u8();
  const std::size_t slices = in.u8();
  const std::size_t slice_bytes = in.u8();
  in.skip(3);
  if (!in.ok()) {
    return ReadStatus::kTooShort;
  }
  if (cause_bytes < kCauseRecordBytes || slice_bytes < kSliceRecordBytes) {
    return ReadStatus::kInconsistent;
  }
  constexpr std::size_t kCounterBytes = 4;
  read_records<std::uint32_t>(
      fates, kCounterBytes, kCounterBytes, end.pose_fates,
      [](wire::ByteReader& from) { return from.u32_be(); }, in);
  read_records<CauseRecord>(causes, cause_bytes, kCauseRecordBytes, end.causes, read_cause, in);
  read_records<SliceRecord>(slices, slice_bytes, kSliceRecordBytes, end.slices, read_slice, in);
  end.slice_count = static_cast<std::uint8_t>(std::min(slices, kMaxSlices));
  const std::optional<MapState> map = read_map_state(in.bytes(in.remaining()));
  if (!in.ok() || !map) {
    return ReadStatus::kTooShort;
  }
  end.map = *map;
  return ReadStatus::kOk;
}

}  // namespace iog::stream
