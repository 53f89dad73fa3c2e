#include "car_block/record.hpp"

#include "checksum/reflected_crc32.hpp"
#include "require/require.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::car_block {
namespace {

// Bytewise is fast enough: this runs once.
std::uint32_t crc_of(std::span<const std::byte> bytes) {
  checksum::ReflectedCrc32<0x04C11DB7, 1> crc;
  crc.update(bytes);
  return crc.value();
}

}  // namespace

Record read_record(Block block, const RecordPlace& place) {
  const std::span<const std::byte> bytes = block.subspan(place.offset, place.capacity);
  wire::ByteReader in(bytes);
  if (in.u32_be() != place.magic) {
    return {.refusal = Refusal::kNoRecord};
  }
  if (in.u16_be() != kVersion) {
    return {.refusal = Refusal::kWrongVersion};
  }
  const bool is_reserved_zero = in.u16_be() == 0;
  const std::size_t length = in.u32_be();
  const std::uint32_t crc = in.u32_be();
  if (length > place.capacity - kRecordHeaderBytes) {
    return {.refusal = Refusal::kWrongLength};
  }
  const std::span<const std::byte> content = bytes.subspan(kRecordHeaderBytes, length);
  if (!is_reserved_zero || crc_of(content) != crc) {
    return {.refusal = Refusal::kDamaged};
  }
  return {.content = content, .crc = crc};
}

void frame_record(WritableBlock block, const RecordPlace& place, std::size_t bytes) {
  require(bytes <= place.capacity - kRecordHeaderBytes);
  const std::span<std::byte> record = block.subspan(place.offset, kRecordHeaderBytes + bytes);
  wire::ByteWriter out(record);
  out.u32_be(place.magic);
  out.u16_be(kVersion);
  out.zeros(2);
  out.u32_be(static_cast<std::uint32_t>(bytes));
  out.u32_be(crc_of(record.subspan(kRecordHeaderBytes)));
}

}  // namespace iog::car_block
