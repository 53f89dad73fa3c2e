#include "net/checksum.hpp"

#include <gtest/gtest.h>
#include <random>

#include "net/frames.hpp"

namespace iog::net {
namespace {

using testing::Frame;
using testing::from_hex;
using testing::reference_checksum;

Frame random_bytes(std::mt19937& random, std::size_t size) {
  Frame bytes(size);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(random());
  }
  return bytes;
}

// RFC 1071, section 3: the sum of these bytes is ddf2.
TEST(Checksum, MatchesTheExampleOfTheRfc) {
  EXPECT_EQ(internet_checksum(from_hex("0001 f203 f4f5 f6f7")), 0xFFFF - 0xDDF2);
}

// The header of a Linux kernel's packet and of a Velodyne lidar's (see frames.hpp).
TEST(Checksum, IsZeroOverDataThatCarriesIt) {
  EXPECT_EQ(internet_checksum(from_hex("4500002273e540004011aed50a0002020a00020f")), 0);
  EXPECT_EQ(internet_checksum(from_hex("450004d200004000ff11b4aac0a801c8ffffffff")), 0);
  EXPECT_EQ(internet_checksum(from_hex("450004d200004000ff110000c0a801c8ffffffff")), 0xB4AA);
}

TEST(Checksum, OfNothingIsAllOnes) {
  EXPECT_EQ(internet_checksum({}), 0xFFFF);
  EXPECT_EQ(internet_checksum(Frame(1514)), 0xFFFF);
}

// All ones is the largest sum there is: every fold carries.
TEST(Checksum, FoldsTheLargestSum) {
  for (const std::size_t size : {2U, 4U, 6U, 1514U, 65534U}) {
    EXPECT_EQ(internet_checksum(Frame(size, std::byte{0xFF})), 0) << size;
  }
}

TEST(Checksum, EqualsTheSlowReferenceAtEveryLengthAndAlignment) {
  std::mt19937 random{1071};
  const Frame bytes = random_bytes(random, 200);
  for (std::size_t start = 0; start < 8; ++start) {
    for (std::size_t size = 0; start + size <= bytes.size(); ++size) {
      const auto part = std::span{bytes}.subspan(start, size);
      ASSERT_EQ(internet_checksum(part), reference_checksum(part)) << start << ' ' << size;
    }
  }
}

// However data is cut, odd pieces included, the pieces sum to the whole.
TEST(Checksum, DoesNotDependOnHowDataIsCut) {
  std::mt19937 random{768};
  for (int round = 0; round < 2000; ++round) {
    const Frame bytes = random_bytes(random, random() % 64);
    Checksum checksum;
    std::span<const std::byte> rest{bytes};
    while (!rest.empty()) {
      const std::size_t size = 1 + random() % rest.size();
      checksum.add(rest.first(size));
      rest = rest.subspan(size);
    }
    ASSERT_EQ(checksum.value(), reference_checksum(bytes));
  }
}

// What is copied is what was summed, at every length and alignment, and nothing beside it.
TEST(Checksum, CopiesWhatItSums) {
  std::mt19937 random{1624};
  const Frame bytes = random_bytes(random, 80);
  for (std::size_t start = 0; start < 4; ++start) {
    for (std::size_t size = 0; start + size <= bytes.size(); ++size) {
      const auto part = std::span{bytes}.subspan(start, size);
      Frame copy(start + size + 3, std::byte{0xEE});
      Checksum checksum;
      checksum.add_copied(part, std::span{copy}.subspan(start));
      ASSERT_EQ(checksum.value(), reference_checksum(part)) << start << ' ' << size;
      Frame expected(start, std::byte{0xEE});
      expected.insert(expected.end(), part.begin(), part.end());
      expected.resize(copy.size(), std::byte{0xEE});
      ASSERT_EQ(copy, expected);
    }
  }
}

TEST(Checksum, WordsAreBytesInNetworkOrder) {
  Checksum checksum;
  checksum.add_u16(0x0001);
  checksum.add_u32(0xF203F4F5);
  checksum.add_u16(0xF6F7);
  EXPECT_EQ(checksum.value(), 0xFFFF - 0xDDF2);
}

}  // namespace
}  // namespace iog::net
