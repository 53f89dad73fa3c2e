#include "protection/profile4.hpp"

#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::protection {
namespace {

constexpr std::size_t kCrcOffset = 8;

std::uint32_t crc_of(std::span<const std::byte> data, std::size_t header_offset,
                     TailRemainder tail = {}) {
  checksum::Crc32P4 crc;
  crc.update(data.first(header_offset + kCrcOffset));
  const std::span<const std::byte> content = data.subspan(header_offset + kProfile4HeaderBytes);
  if (tail) {
    crc.update(content.first(content.size() - checksum::Crc32P4::kPartBytes));
    crc.add_remainder(*tail);
  } else {
    crc.update(content);
  }
  return crc.value();
}

}  // namespace

void Profile4Protector::protect(std::span<std::byte> data, TailRemainder tail) {
  wire::ByteWriter out(data.subspan(profile_.offset_bytes));
  out.u16_be(static_cast<std::uint16_t>(data.size()));
  out.u16_be(counter_++);
  out.u32_be(profile_.data_id);
  out.u32_be(crc_of(data, profile_.offset_bytes, tail));
}

CheckStatus Profile4Checker::check(std::span<const std::byte> data) {
  if (data.size() < profile_.offset_bytes + kProfile4HeaderBytes) {
    return CheckStatus::kError;
  }
  wire::ByteReader in(data.subspan(profile_.offset_bytes));
  const std::uint16_t length = in.u16_be();
  const std::uint16_t counter = in.u16_be();
  const std::uint32_t data_id = in.u32_be();
  const std::uint32_t crc = in.u32_be();
  if (length != data.size() || data_id != profile_.data_id ||
      crc != crc_of(data, profile_.offset_bytes)) {
    return CheckStatus::kError;
  }
  delta_counter_ = static_cast<std::uint16_t>(counter - counter_);
  counter_ = counter;
  if (delta_counter_ > profile_.max_delta_counter) {
    return CheckStatus::kWrongSequence;
  }
  if (delta_counter_ == 0) {
    return CheckStatus::kRepeated;
  }
  return delta_counter_ == 1 ? CheckStatus::kOk : CheckStatus::kOkSomeLost;
}

}  // namespace iog::protection
