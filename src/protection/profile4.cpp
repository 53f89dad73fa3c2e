#include "protection/profile4.hpp"

#include "wire/byte_order.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::protection {
namespace {

constexpr std::size_t kCrcOffset = 8;
constexpr std::size_t kCrcBytes = sizeof(std::uint32_t);

std::uint32_t crc_of(std::span<const std::byte> data, std::size_t header_offset) {
  checksum::Crc32P4 crc;
  crc.update(data.first(header_offset + kCrcOffset));
  crc.update(data.subspan(header_offset + kProfile4HeaderBytes));
  return crc.value();
}

void move_word(std::span<std::byte> data, std::size_t from, std::size_t to) {
  wire::store_le32(data.subspan(to).first<kCrcBytes>(),
                   wire::load_le32(data.subspan(from).first<kCrcBytes>()));
}

// While the bytes before the CRC are moved up by its length, all bytes that it covers are
// contiguous.
std::uint32_t crc_of(std::span<std::byte> data, std::size_t header_offset, std::uint32_t tail) {
  const std::size_t crc_offset = header_offset + kCrcOffset;
  for (std::size_t at = crc_offset; at > 0; at -= kCrcBytes) {
    move_word(data, at - kCrcBytes, at);
  }
  checksum::Crc32P4 crc;
  const std::span covered = data.subspan(kCrcBytes);
  crc.add_remainder(covered.first(covered.size() - checksum::Crc32P4::kPartBytes), tail);
  for (std::size_t at = 0; at < crc_offset; at += kCrcBytes) {
    move_word(data, at + kCrcBytes, at);
  }
  return crc.value();
}

}  // namespace

void Profile4Protector::protect(std::span<std::byte> data, TailRemainder tail) {
  wire::ByteWriter out(data.subspan(profile_.offset_bytes));
  out.u16_be(static_cast<std::uint16_t>(data.size()));
  out.u16_be(counter_++);
  out.u32_be(profile_.data_id);
  out.u32_be(tail ? crc_of(data, profile_.offset_bytes, *tail)
                  : crc_of(data, profile_.offset_bytes));
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
