// Reads MCAP files of any writer from beginning to end. If the end of a file is missing, what is
// there is read. What is damaged is counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/mcap/format.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools::mcap {

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;
  std::uint64_t publish_ns = 0;
  std::span<const std::byte> data;  // valid until the next one is read
};

struct ReadCounts {
  std::uint64_t chunks = 0;
  std::uint64_t messages = 0;
  std::uint64_t broken_chunks = 0;      // their CRC, their compression or their lengths are wrong
  std::uint64_t unreadable_chunks = 0;  // compressed by what is not known here, or too large
  std::uint64_t malformed = 0;   // records whose lengths contradict each other, or are absurd;
                                 // messages of no known channel, chunks in chunks
  std::uint64_t behind_end = 0;  // bytes, not read
  std::uint64_t chunk_index_entries = 0;  // of the summary
};

class Reader {
 public:
  // The stream outlives the reader. UsageError if it is no MCAP file.
  explicit Reader(std::istream& in);

  // The next message in the order of the file; nothing at its end.
  [[nodiscard]] std::optional<Message> next();

  // Where the record of the file begins that the last message was in, mostly a chunk.
  [[nodiscard]] std::uint64_t place() const { return record_at_; }

  // Goes on from a place(): the next message is the first one of that record. Channels that have
  // been read stay; what is read again is counted again.
  void go_to(std::uint64_t place);

  [[nodiscard]] const ReadCounts& counts() const { return counts_; }
  [[nodiscard]] const std::string& profile() const { return profile_; }
  [[nodiscard]] const std::string& library() const { return library_; }
  [[nodiscard]] const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  // What the file says of itself, by name.
  [[nodiscard]] const std::map<std::string, Metadata>& metadata() const { return metadata_; }
  // The compression of the first chunk.
  [[nodiscard]] const std::string& compression() const { return compression_; }
  // The number of messages in the file's statistics, if it has any.
  [[nodiscard]] std::optional<std::uint64_t> promised_messages() const { return promised_; }
  // How much of the file has been read, 0 to 1.
  [[nodiscard]] double part_read() const;
  // Whether the last record and the magic number at the end are there. Known when all has been
  // read.
  [[nodiscard]] bool is_finished() const { return is_finished_; }

 private:
  struct Record {
    OpCode code{};
    std::span<const std::byte> content;
  };

  [[nodiscard]] std::optional<Record> next_of_file();
  [[nodiscard]] std::optional<Record> next_of_chunk();
  [[nodiscard]] std::optional<Message> take(const Record& record);
  void open_chunk(std::span<const std::byte> content);
  [[nodiscard]] bool unpack(std::span<const std::byte> records, std::uint64_t bytes);
  void take_description(const Record& record);
  void take_schema(wire::ByteReader in);
  void take_channel(wire::ByteReader in);
  void take_metadata(wire::ByteReader in);

  std::istream* in_;
  std::uint64_t bytes_ = 0;      // of the file
  std::uint64_t remaining_ = 0;  // of them
  std::uint64_t record_at_ = 0;  // where the last record of the file begins
  std::vector<std::byte> record_;
  std::unique_ptr<std::byte[]> unpacked_;
  wire::ByteReader chunk_{{}};  // what is left of the chunk that is open
  ReadCounts counts_;
  std::string profile_;
  std::string library_;
  std::string compression_;
  std::map<std::uint16_t, Schema> schemas_;
  std::uint64_t schema_bytes_ = 0;  // of their definitions
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::string, Metadata> metadata_;
  std::optional<std::uint64_t> promised_;
  bool is_finished_ = false;
};

}  // namespace iog::tools::mcap
