// Defines the location and layout of the car block in an image (docs/spec.md, section 8).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::car_block {

// The offset of the block from the first byte of the image. The image starts with the exception
// vectors. The linker script linker/image.ld places the block at this offset.
inline constexpr std::size_t kOffsetInImage = 0x1000;
inline constexpr std::size_t kBlockBytes = 65'536;

using Block = std::span<const std::byte, kBlockBytes>;
using WritableBlock = std::span<std::byte, kBlockBytes>;

// A record consists of a header and content. The header consists of a magic number, a version, two
// reserved zero bytes, and the length and the CRC-32 of the content.
inline constexpr std::size_t kRecordHeaderBytes = 16;
inline constexpr std::uint16_t kVersion = 1;

struct RecordPlace {
  std::uint32_t magic = 0;
  std::size_t offset = 0;
  std::size_t capacity = 0;  // size in bytes, including the header
};

inline constexpr RecordPlace kFirmwareRecord{0x494F4746, 0, 32};  // "IOGF"
inline constexpr RecordPlace kKeyRecord{0x494F474B, 32, 32};      // "IOGK"; all zeros if no key
inline constexpr RecordPlace kNetworkRecord{0x494F474E, 64, 64};  // "IOGN"
inline constexpr RecordPlace kNetworkCopy{0x494F474E, kBlockBytes - 64, 64};
inline constexpr RecordPlace kCarRecord{0x494F4743, 128, kBlockBytes - 64 - 128};  // "IOGC"

}  // namespace iog::car_block
