// The messages of what was received, byte by byte as docs/spec.md 3.13 lists them, and what a
// receiver must not believe.
#include "stream/receptions.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/bytes_of.hpp"
#include "protection/protected_message.hpp"

namespace iog::stream {
namespace {

using tests::Bytes;
using tests::bytes_of;

// Offsets in a part.
enum At : std::size_t { kHead = 1, kSize = 3, kCount = 5, kPart = 6, kParts = 7, kTime = 24 };

const std::vector<Reception> kTwo{
    {.port = 0x0A0B, .was_left = false, .key = 0x01020304, .before_close_us = 0x0011'1213},
    {.port = 15010, .was_left = true, .key = 0xFFFFFFFF, .before_close_us = 7}};

Bytes bytes_of_two() {
  return bytes_of({
      0,    16,   0,    12,   0,    2,    0,    1,     // of the header, of a record; count, part
      0,    0,    0,    9,    0,    0,    0,    0,     // not listed
      0x0A, 0x0B, 0,    0,    0x01, 0x02, 0x03, 0x04,  // port, flags, key
      0x00, 0x11, 0x12, 0x13,                          // before the end
      0x3A, 0xA2, 1,    0,    0xFF, 0xFF, 0xFF, 0xFF,  // the other
      0,    0,    0,    7,
  });
}

Bytes part_of(const std::vector<Reception>& list, std::size_t part) {
  Bytes buffer(2000);
  buffer.resize(write_receptions(list, 9, part, buffer));
  return buffer;
}

ReadStatus status_of(const Bytes& bytes) {
  ReceptionPart part;
  return read_receptions(bytes, part);
}

Bytes with(Bytes bytes, std::size_t at, int value) {
  bytes.at(at) = static_cast<std::byte>(value);
  return bytes;
}

TEST(Receptions, AreWrittenAndReadAsTheSpecificationSays) {
  EXPECT_EQ(part_of(kTwo, 0), bytes_of_two());
  ReceptionPart part;
  ASSERT_EQ(read_receptions(bytes_of_two(), part), ReadStatus::kOk);
  EXPECT_EQ(part.header, (ReceptionsHeader{.receptions = 2, .parts = 1, .not_listed = 9}));
  EXPECT_EQ(std::vector(part.all().begin(), part.all().end()), kTwo);
}

TEST(Receptions, OfNothingAreOneMessage) {
  EXPECT_EQ(reception_parts_of(0), 1U);
  EXPECT_EQ(part_of({}, 0), bytes_of({0, 16, 0, 12, 0, 0, 0, 1, 0, 0, 0, 9, 0, 0, 0, 0}));
  EXPECT_EQ(status_of(part_of({}, 0)), ReadStatus::kOk);
}

TEST(Receptions, GoInMessagesOf100) {
  std::vector<Reception> all;
  for (std::uint32_t i = 0; i < kMaxReceptions; ++i) {
    all.push_back({.port = 2368, .key = i, .before_close_us = 5000 - i});
  }
  ASSERT_EQ(reception_parts_of(all.size()), 13U);
  std::vector<Reception> read;
  for (std::size_t number = 0; number < 13; ++number) {
    const Bytes bytes = part_of(all, number);
    EXPECT_EQ(bytes.size(), 16U + 100 * 12);
    EXPECT_LE(protection::kProtectionBytes + kHeaderBytes + bytes.size(),
              protection::kMaxMessageBytes);
    ReceptionPart part;
    ASSERT_EQ(read_receptions(bytes, part), ReadStatus::kOk);
    EXPECT_EQ(part.part, number);
    read.insert(read.end(), part.all().begin(), part.all().end());
  }
  EXPECT_EQ(read, all);
}

TEST(Receptions, ThatContradictThemselvesAreRefused) {
  const Bytes good = bytes_of_two();
  EXPECT_EQ(status_of(with(good, kHead, 15)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kHead, 17)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kHead, 60)), ReadStatus::kTooShort);
  EXPECT_EQ(status_of(with(good, kSize, 11)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kSize, 13)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kCount, 1)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kCount, 3)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kPart, 1)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kParts, 0)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kParts, 2)), ReadStatus::kInconsistent);
  EXPECT_EQ(status_of(with(good, kCount - 1, 255)), ReadStatus::kInconsistent) << "too many";
  EXPECT_EQ(status_of(with(with(with(good, kTime, 0), kTime + 1, 0), kTime + 2, 0)),
            ReadStatus::kOk)
      << "0x13 before the end, then 7";
  EXPECT_EQ(
      status_of(with(with(with(with(good, kTime, 0), kTime + 1, 0), kTime + 2, 0), kTime + 3, 6)),
      ReadStatus::kInconsistent)
      << "time goes back";
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(status_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))),
              ReadStatus::kOk)
        << size;
  }
}

TEST(Receptions, SkipTheFieldsOfALaterVersion) {
  Bytes later = bytes_of({0, 18, 0, 13, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xEE, 0xEE});
  const Bytes record = bytes_of({0, 5, 0, 0, 0, 0, 0, 6, 0, 0, 0, 8, 0xEE});
  later.insert(later.end(), record.begin(), record.end());
  ReceptionPart part;
  ASSERT_EQ(read_receptions(later, part), ReadStatus::kOk);
  EXPECT_EQ(part.all()[0], (Reception{.port = 5, .key = 6, .before_close_us = 8}));
}

// zlib's CRC-32: of "123456789" 0xCBF43926; of 64 zeros and 64 bytes 0xFF, computed with Python.
TEST(Receptions, NameDatagramsByTheirEnds) {
  EXPECT_EQ(key_of(bytes_of({'1', '2', '3', '4', '5', '6', '7', '8', '9'})), 0xCBF43926U);
  Bytes ends(64, std::byte{0});
  ends.resize(128, std::byte{0xFF});
  EXPECT_EQ(key_of(ends), 0xB8441E11U);
  Bytes longer(64, std::byte{0});
  longer.resize(1142, std::byte{0x5A});
  longer.resize(1206, std::byte{0xFF});
  EXPECT_EQ(key_of(longer), 0xB8441E11U);
}

}  // namespace
}  // namespace iog::stream
