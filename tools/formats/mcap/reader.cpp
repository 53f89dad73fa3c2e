#include "tools/formats/mcap/reader.hpp"

#include <algorithm>
#include <zstd.h>

#include "stream/crc32.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools::mcap {
namespace {

// A chunk that says that it holds more is not unpacked. Writers make chunks of some megabytes.
constexpr std::uint64_t kMaxChunkBytes = 256U << 20;
// A record that is longer is passed over: it need not fit into memory. A chunk's own fields and
// what does not compress are shorter than that.
constexpr std::uint64_t kMaxRecordBytes = kMaxChunkBytes + (1U << 20);

// All definitions together. Those of ROS 2 have some kilobytes each.
constexpr std::uint64_t kMaxSchemaBytes = 64U << 20;

std::string string_of(wire::ByteReader& in) {
  const std::span<const std::byte> bytes = in.bytes(in.u32_le());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Metadata map_of(wire::ByteReader& in) {
  Metadata entries;
  wire::ByteReader inner(in.bytes(in.u32_le()));
  while (inner.remaining() > 0) {
    std::string key = string_of(inner);
    std::string value = string_of(inner);
    if (inner.ok()) {
      entries.insert_or_assign(std::move(key), std::move(value));
    }
  }
  return entries;
}

bool is_magic(std::span<const std::byte> bytes) {
  return std::ranges::equal(bytes, std::as_bytes(std::span(kMagic)));
}

}  // namespace

Reader::Reader(std::istream& in) : in_(&in) {
  in.seekg(0, std::ios::end);
  const std::streamoff bytes = in.tellg();
  in.seekg(0);
  std::array<std::byte, kMagic.size()> magic{};
  in.read(reinterpret_cast<char*>(magic.data()), magic.size());
  if (!in || !is_magic(magic)) {
    throw UsageError("not an MCAP file");
  }
  bytes_ = static_cast<std::uint64_t>(bytes);
  remaining_ = bytes_ - magic.size();
}

double Reader::part_read() const {
  return 1 - static_cast<double>(remaining_) / static_cast<double>(bytes_);
}

void Reader::go_to(std::uint64_t place) {
  in_->clear();
  in_->seekg(static_cast<std::streamoff>(place));
  record_at_ = place;
  remaining_ = bytes_ - std::min(bytes_, place);
  chunk_ = wire::ByteReader({});
  is_finished_ = false;
}

std::optional<Message> Reader::next() {
  while (const std::optional<Record> record =
             chunk_.remaining() > 0 ? next_of_chunk() : next_of_file()) {
    if (std::optional<Message> message = take(*record)) {
      return message;
    }
  }
  return std::nullopt;
}

// Nothing at the end of the file, and where it breaks off.
std::optional<Reader::Record> Reader::next_of_file() {
  std::array<std::byte, kRecordHeadBytes> head{};
  if (is_finished_ || remaining_ < head.size()) {
    return std::nullopt;
  }
  record_at_ = bytes_ - remaining_;
  in_->read(reinterpret_cast<char*>(head.data()), head.size());
  remaining_ -= head.size();
  wire::ByteReader reader(head);
  const auto code = static_cast<OpCode>(reader.u8());
  const std::uint64_t bytes = reader.u64_le();
  if (bytes > remaining_) {
    remaining_ = 0;
    return std::nullopt;
  }
  if (bytes > kMaxRecordBytes) {
    in_->seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    remaining_ -= bytes;
    counts_.unreadable_chunks += code == OpCode::kChunk ? 1U : 0U;
    counts_.malformed += code == OpCode::kMessage ? 1U : 0U;
    return Record{};
  }
  record_.resize(bytes);
  in_->read(reinterpret_cast<char*>(record_.data()), static_cast<std::streamsize>(bytes));
  remaining_ -= bytes;
  if (!*in_) {
    remaining_ = 0;
    return std::nullopt;
  }
  return Record{.code = code, .content = record_};
}

// Something always: where the chunk's own lengths are wrong, a record that means nothing.
std::optional<Reader::Record> Reader::next_of_chunk() {
  const auto code = static_cast<OpCode>(chunk_.u8());
  const std::uint64_t bytes = chunk_.u64_le();
  const std::span<const std::byte> content = chunk_.bytes(bytes);
  if (!chunk_.ok()) {
    ++counts_.malformed;
    chunk_ = wire::ByteReader({});
    return Record{};
  }
  const bool may_be_there =
      code == OpCode::kSchema || code == OpCode::kChannel || code == OpCode::kMessage;
  counts_.malformed += code == OpCode::kChunk ? 1U : 0U;
  return Record{.code = may_be_there ? code : OpCode{}, .content = content};
}

std::optional<Message> Reader::take(const Record& record) {
  if (record.code == OpCode::kChunk) {
    open_chunk(record.content);
    return std::nullopt;
  }
  if (record.code != OpCode::kMessage) {
    take_description(record);
    return std::nullopt;
  }
  wire::ByteReader in(record.content);
  Message message;
  message.channel_id = in.u16_le();
  message.sequence = in.u32_le();
  message.log_ns = in.u64_le();
  message.publish_ns = in.u64_le();
  if (!in.ok() || !channels_.contains(message.channel_id)) {
    ++counts_.malformed;
    return std::nullopt;
  }
  message.data = in.bytes(in.remaining());
  ++counts_.messages;
  return message;
}

void Reader::open_chunk(std::span<const std::byte> content) {
  wire::ByteReader in(content);
  in.skip(8 + 8);
  const std::uint64_t bytes = in.u64_le();
  const std::uint32_t crc = in.u32_le();
  const std::string compression = string_of(in);
  const std::span<const std::byte> records = in.bytes(in.u64_le());
  compression_ = counts_.chunks++ == 0 ? compression : compression_;
  if (!in.ok()) {
    ++counts_.broken_chunks;
    return;
  }
  const bool is_plain = compression.empty();
  if ((!is_plain && compression != "zstd") || (!is_plain && bytes > kMaxChunkBytes)) {
    ++counts_.unreadable_chunks;
    return;
  }
  if (is_plain ? records.size() != bytes : !unpack(records, bytes)) {
    ++counts_.broken_chunks;
    return;
  }
  const std::span<const std::byte> plain =
      is_plain ? records : std::span<const std::byte>(unpacked_.get(), bytes);
  stream::Crc32 found;
  found.update(plain);
  if (crc != 0 && crc != found.value()) {
    ++counts_.broken_chunks;
    return;
  }
  chunk_ = wire::ByteReader(plain);
}

bool Reader::unpack(std::span<const std::byte> records, std::uint64_t bytes) {
  unpacked_ = std::make_unique_for_overwrite<std::byte[]>(bytes);
  return ZSTD_decompress(unpacked_.get(), bytes, records.data(), records.size()) == bytes;
}

// Records that tell of others. What is not known here is passed over, as the specification wants.
void Reader::take_description(const Record& record) {
  wire::ByteReader in(record.content);
  switch (record.code) {
    case OpCode::kHeader:
      profile_ = string_of(in);
      library_ = string_of(in);
      break;
    case OpCode::kSchema:
      take_schema(in);
      break;
    case OpCode::kChannel:
      take_channel(in);
      break;
    case OpCode::kMetadata:
      take_metadata(in);
      break;
    case OpCode::kChunkIndex:
      ++counts_.chunk_index_entries;
      break;
    case OpCode::kStatistics:
      promised_ = in.u64_le();
      break;
    case OpCode::kFooter: {
      std::array<std::byte, kMagic.size()> magic{};
      in_->read(reinterpret_cast<char*>(magic.data()), magic.size());
      is_finished_ = *in_ && is_magic(magic);
      counts_.behind_end = remaining_ > magic.size() ? remaining_ - magic.size() : 0;
      remaining_ = 0;
      break;
    }
    default:
      break;
  }
}

void Reader::take_schema(wire::ByteReader in) {
  const std::uint16_t id = in.u16_le();
  Schema schema{.name = string_of(in), .encoding = string_of(in), .text = string_of(in)};
  const std::uint64_t bytes = schema.text.size() + (schemas_.contains(id) ? 0 : schema_bytes_);
  if (in.ok() && bytes <= kMaxSchemaBytes) {
    schema_bytes_ += schemas_.contains(id) ? 0 : schema.text.size();
    schemas_.try_emplace(id, std::move(schema));
  } else {
    ++counts_.malformed;
  }
}

void Reader::take_channel(wire::ByteReader in) {
  const std::uint16_t id = in.u16_le();
  Channel channel{.schema_id = in.u16_le(),
                  .topic = string_of(in),
                  .message_encoding = string_of(in),
                  .metadata = map_of(in)};
  if (in.ok()) {
    channels_.try_emplace(id, std::move(channel));
  } else {
    ++counts_.malformed;
  }
}

void Reader::take_metadata(wire::ByteReader in) {
  std::string name = string_of(in);
  Metadata entries = map_of(in);
  if (in.ok()) {
    metadata_.insert_or_assign(std::move(name), std::move(entries));
  } else {
    ++counts_.malformed;
  }
}

}  // namespace iog::tools::mcap
