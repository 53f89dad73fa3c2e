#include "stream/receptions.hpp"

#include <algorithm>
#include <limits>

#include "stream/crc32.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::stream {
namespace {

constexpr std::uint16_t kReceptionBytes = 12;
constexpr std::uint8_t kWasLeft = 0x01;
constexpr std::size_t kKeyedBytes = 64;  // at each end

// The number of records in this part.
constexpr std::size_t count_of_part(std::size_t receptions, std::size_t part) {
  return std::min(receptions - std::min(receptions, part * kMaxReceptionsOfAPart),
                  kMaxReceptionsOfAPart);
}

bool is_part_of(const ReceptionsHeader& header, std::size_t part, std::size_t count) {
  return header.receptions <= kMaxReceptions &&
         header.parts == reception_parts_of(header.receptions) && part < header.parts &&
         count == count_of_part(header.receptions, part);
}

}  // namespace

std::uint32_t key_of(std::span<const std::byte> payload) {
  Crc32 crc;
  if (payload.size() <= 2 * kKeyedBytes) {
    crc.update(payload);
  } else {
    crc.update(payload.first(kKeyedBytes));
    crc.update(payload.last(kKeyedBytes));
  }
  return crc.value();
}

std::size_t write_receptions(std::span<const Reception> list, std::uint32_t not_listed,
                             std::size_t part, std::span<std::byte> buffer) {
  wire::ByteWriter out(buffer);
  out.u16_be(kReceptionsHeaderBytes);
  out.u16_be(kReceptionBytes);
  out.u16_be(static_cast<std::uint16_t>(list.size()));
  out.u8(static_cast<std::uint8_t>(part));
  out.u8(static_cast<std::uint8_t>(reception_parts_of(list.size())));
  out.u32_be(not_listed);
  out.u32_be(0);
  const std::span<const Reception> rest = list.subspan(part * kMaxReceptionsOfAPart);
  for (const Reception& reception : rest.first(count_of_part(list.size(), part))) {
    out.u16_be(reception.port);
    out.u8(reception.was_left ? kWasLeft : 0);
    out.u8(0);
    out.u32_be(reception.key);
    out.u32_be(reception.before_close_us);
  }
  return out.ok() ? out.written().size() : 0;
}

ReadStatus read_receptions(std::span<const std::byte> body, ReceptionPart& part) {
  wire::ByteReader in(body);
  const std::size_t header_bytes = in.u16_be();
  const std::size_t record_bytes = in.u16_be();
  part.header.receptions = in.u16_be();
  part.part = in.u8();
  part.header.parts = in.u8();
  part.header.not_listed = in.u32_be();
  if (!in.ok() || body.size() < kReceptionsHeaderBytes || body.size() < header_bytes) {
    return ReadStatus::kTooShort;
  }
  if (header_bytes < kReceptionsHeaderBytes || record_bytes < kReceptionBytes ||
      (body.size() - header_bytes) % record_bytes != 0) {
    return ReadStatus::kInconsistent;
  }
  const std::size_t count = (body.size() - header_bytes) / record_bytes;
  if (!is_part_of(part.header, part.part, count)) {
    return ReadStatus::kInconsistent;
  }
  part.count = static_cast<std::uint8_t>(count);
  std::uint32_t before = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < count; ++i) {
    wire::ByteReader record(body.subspan(header_bytes + i * record_bytes, record_bytes));
    Reception& reception = part.records[i];
    reception.port = record.u16_be();
    reception.was_left = (record.u8() & kWasLeft) != 0;
    record.skip(1);
    reception.key = record.u32_be();
    reception.before_close_us = record.u32_be();
    if (reception.before_close_us > before) {
      return ReadStatus::kInconsistent;
    }
    before = reception.before_close_us;
  }
  return ReadStatus::kOk;
}

}  // namespace iog::stream
