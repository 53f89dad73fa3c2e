#include "tools/identity/foreign_unit.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "lidar/velodyne.hpp"
#include "lidar/velodyne_bytes.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using Bytes = std::span<const std::byte>;

std::uint8_t byte_at(Bytes bytes, std::size_t at) {
  return wire::load_u8(bytes.subspan(at).first<1>());
}

std::uint16_t half_at(Bytes bytes, std::size_t at) {
  return wire::load_le16(bytes.subspan(at).first<2>());
}

bool begins(Bytes bytes, std::initializer_list<std::uint8_t> with) {
  return bytes.size() >= with.size() &&
         std::equal(with.begin(), with.end(), bytes.begin(),
                    [](std::uint8_t a, std::byte b) { return std::byte{a} == b; });
}

// The banks of a VLS-128 have four flags (VLS-128 User Manual, "Packet structure"); what has one
// bank names itself in its last byte.
std::string_view velodyne(Bytes bytes) {
  constexpr std::uint16_t kThirdBank = 0xCCFF;
  constexpr std::uint16_t kFourthBank = 0xBBFF;
  if (bytes.size() != lidar::VelodynePacket::kPacketBytes ||
      half_at(bytes, 0) != lidar::velodyne::kBlockFlag) {
    return {};
  }
  for (std::size_t block = 0; block < lidar::VelodynePacket::kBlocks; ++block) {
    const std::uint16_t flag = half_at(bytes, block * lidar::VelodynePacket::kBlockBytes);
    if (flag == kThirdBank || flag == kFourthBank) {
      return "Velodyne VLS-128";
    }
  }
  switch (byte_at(bytes, lidar::velodyne::kProductOffset)) {
    case 0x23:
      return "Velodyne VLP-32A or VLP-32B";
    case 0x63:
    case 0xA1:
      return "Velodyne VLS-128";
    default:
      return {};
  }
}

// Pandar40P User Manual, "Point cloud UDP data": 10 blocks of 124 bytes, each with a flag, and 22
// bytes of tail, with or without a sequence of 4. 0x42 is the maker's byte.
std::string_view pandar40p(Bytes bytes) {
  constexpr std::size_t kBlocks = 10;
  constexpr std::size_t kBlockBytes = 124;
  constexpr std::size_t kMakerAt = kBlocks * kBlockBytes + 15;
  if ((bytes.size() != 1262 && bytes.size() != 1266) || byte_at(bytes, kMakerAt) != 0x42) {
    return {};
  }
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (half_at(bytes, block * kBlockBytes) != lidar::velodyne::kBlockFlag) {
      return {};
    }
  }
  return "Hesai Pandar40P";
}

struct HesaiHeader {
  std::uint8_t major;
  std::uint8_t minor;
  std::uint8_t lasers;  // 0: any
  std::uint8_t blocks;  // 0: any
  std::size_t bytes;    // at least: header, blocks of an azimuth and a distance for each laser
  std::string_view name;
};
// Hesai's manuals, "Pre-header" and "Header": version of the protocol, lasers, blocks.
constexpr std::array<HesaiHeader, 11> kHesaiHeaders{
    {{1, 3, 128, 2, 12 + 2 * (2 + 3 * 128), "Hesai Pandar128"},
     {1, 4, 128, 2, 12 + 2 * (2 + 3 * 128), "Hesai Pandar128 or OT128"},
     {3, 1, 64, 4, 12 + 4 * (2 + 4 * 64), "Hesai PandarQT-64"},
     {3, 2, 128, 2, 12 + 2 * (2 + 4 * 128), "Hesai QT128"},
     {4, 1, 128, 0, 12 + 2 * (3 + 4 * 128), "Hesai AT128"},
     {4, 3, 128, 0, 12 + 2 * (3 + 4 * 128), "Hesai AT128"},
     {6, 1, 16, 8, 12 + 8 * (2 + 4 * 16), "Hesai PandarXT-16"},
     {6, 1, 32, 6, 12 + 6 * (2 + 4 * 32), "Hesai PandarXT-32M"},
     {6, 1, 32, 8, 12 + 8 * (2 + 4 * 32), "Hesai PandarXT-32"},
     {64, 6, 0, 0, 8 + 6 * (2 + 3 * 64), "Hesai Pandar64"},
     {20, 20, 0, 0, 8 + 20 * (2 + 3 * 20), "Hesai Pandar20"}}};

// Units of ours are among them, and the Pandar40P is one: what of theirs comes here is in a mode
// that is not taken.
std::string_view hesai(Bytes bytes) {
  if (!begins(bytes, {0xEE, 0xFF})) {
    return {};
  }
  for (const HesaiHeader& header : kHesaiHeaders) {
    if (bytes.size() >= header.bytes && byte_at(bytes, 2) == header.major &&
        byte_at(bytes, 3) == header.minor &&
        (header.lasers == 0 || byte_at(bytes, 6) == header.lasers) &&
        (header.blocks == 0 || byte_at(bytes, 7) == header.blocks)) {
      return header.name;
    }
  }
  return {};
}

// RS-LiDAR-16 User Guide, "MSOP" and "DIFOP"; later units have another beginning.
std::string_view robosense(Bytes bytes) {
  if (begins(bytes, {0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0})) {
    return "RoboSense RS-16, RS-32 or Bpearl";
  }
  const bool is_theirs = begins(bytes, {0x55, 0xAA, 0x05, 0x5A}) ||
                         begins(bytes, {0x55, 0xAA, 0x5A, 0xA5}) ||
                         begins(bytes, {0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55});
  return is_theirs ? "RoboSense lidar" : "";
}

// Livox "Communication protocol", "Point cloud data": version 0, the packet's length, how many
// points of which type; 36 bytes come before the first.
std::string_view livox(Bytes bytes) {
  constexpr std::size_t kHeaderBytes = 36;
  constexpr std::array<std::size_t, 4> kPointBytes{24, 14, 8, 10};  // 0: of the gyroscope
  if (bytes.size() < kHeaderBytes || byte_at(bytes, 0) != 0 || half_at(bytes, 1) != bytes.size()) {
    return {};
  }
  const std::size_t points = half_at(bytes, 5);
  const std::size_t type = byte_at(bytes, 10);
  const bool is_theirs = type < kPointBytes.size() && points > 0 &&
                         bytes.size() == kHeaderBytes + points * kPointBytes[type];
  return is_theirs ? "Livox lidar" : "";
}

}  // namespace

std::string_view name_of_foreign(Bytes payload) {
  for (const auto maker : {velodyne, pandar40p, hesai, robosense, livox}) {
    if (const std::string_view name = maker(payload); !name.empty()) {
      return name;
    }
  }
  return {};
}

}  // namespace iog::tools
