// Writes MCAP files: chunks, each with its message indexes, and at the end the summary by which a
// reader finds its way. docs/recordings.md says why this is written here.
//
// The bytes depend on nothing but what is written (and, compressed, on the version of libzstd).
// What has been written reaches the file chunk by chunk: a program that is killed leaves a file
// that can be read up to its last chunk, if keep_beginning() was called.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stream/crc32.hpp"
#include "tools/formats/mcap/format.hpp"
#include "tools/formats/mcap/record_bytes.hpp"
#include "tools/program/file.hpp"

struct ZSTD_CCtx_s;

namespace iog::tools::mcap {

class Writer {
 public:
  // UsageError if the file cannot be written. Without keep_beginning() and finish(), an older file
  // stays (OutputPlace).
  Writer(const std::string& path, std::string_view profile, Compression compression);

  // Return the ids, counted from 1. A channel's schema comes before it.
  std::uint16_t add_schema(const Schema& schema);
  std::uint16_t add_channel(const Channel& channel);

  struct Times {
    std::uint64_t log_ns = 0;      // when it was recorded
    std::uint64_t publish_ns = 0;  // when it was sent, by the sender's clock
  };
  // The next message of that channel. UsageError if the disk is full.
  void write(std::uint16_t channel_id, const Times& times, std::span<const std::byte> data);

  // Replaces an older file now, even if finish() is never called.
  void keep_beginning() { place_.finish(); }

  // UsageError if not all has been written. Nothing may be written after it. The metadata is what
  // is to be known of the whole file.
  void finish(std::string_view metadata_name, const Metadata& metadata);

 private:
  struct Extent {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    bool is_empty = true;
    void add(std::uint64_t time_ns);
  };
  struct FreeContext {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  using Index = std::vector<std::pair<std::uint64_t, std::uint64_t>>;  // log time, offset

  void append(std::span<const std::byte> bytes);
  void append(OpCode code, const RecordBytes& content);
  void end_chunk();
  [[nodiscard]] std::span<const std::byte> compressed_chunk();
  void append_chunk(std::span<const std::byte> records);
  [[nodiscard]] std::map<std::uint16_t, std::uint64_t> append_message_indexes();
  void append_metadata(std::string_view name, const Metadata& metadata);
  void append_summary();
  [[nodiscard]] RecordBytes statistics() const;

  std::string path_;
  OutputPlace place_;
  std::ofstream file_;
  Compression compression_;
  std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;
  std::uint64_t position_ = 0;
  stream::Crc32 crc_;  // of the data section

  // Of the whole file, for its summary.
  RecordBytes schemas_;
  RecordBytes channels_;
  RecordBytes chunk_indexes_;
  RecordBytes metadata_indexes_;
  std::uint16_t schema_count_ = 0;
  std::uint16_t channel_count_ = 0;
  std::uint32_t chunk_count_ = 0;
  std::uint32_t metadata_count_ = 0;
  std::map<std::uint16_t, std::uint32_t> message_counts_;  // by channel
  Extent extent_;

  // Of the chunk that is being filled.
  RecordBytes chunk_;
  std::map<std::uint16_t, Index> index_;  // by channel
  Extent chunk_extent_;
  std::vector<std::byte> compressed_;
};

}  // namespace iog::tools::mcap
