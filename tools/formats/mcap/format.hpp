// What the writer and the reader of MCAP files (https://mcap.dev/spec) both know.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace iog::tools::mcap {

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class OpCode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

// Before a record's content: operation code and length.
inline constexpr std::size_t kRecordHeadBytes = 1 + 8;
// Before a message's data: channel, sequence number, log time, publish time.
inline constexpr std::size_t kMessageHeadBytes = 2 + 4 + 8 + 8;
// Two offsets and a CRC.
inline constexpr std::size_t kFooterBytes = 8 + 8 + 4;

enum class Compression : std::uint8_t { kNone, kZstd };

struct Schema {
  std::string name;
  std::string encoding;
  std::string text;
};

using Metadata = std::map<std::string, std::string>;

struct Channel {
  std::uint16_t schema_id = 0;  // 0: none
  std::string topic;
  std::string message_encoding;
  Metadata metadata;
};

}  // namespace iog::tools::mcap
