#include "tools/formats/mcap/writer.hpp"

#include <algorithm>
#include <cerrno>
#include <zstd.h>

#include "require/require.hpp"

namespace iog::tools::mcap {
namespace {

// A chunk ends when it holds so much, or so much time: little memory here, little to lose there.
constexpr std::size_t kChunkBytes = 1 << 20;
constexpr std::uint64_t kChunkNs = 1'000'000'000;

// libzstd's own default. Level 1 is a third faster and its files are larger.
constexpr int kZstdLevel = 3;

std::string_view name_of(Compression compression) {
  return compression == Compression::kZstd ? "zstd" : "";
}

std::uint32_t crc_of(std::span<const std::byte> bytes) {
  stream::Crc32 crc;
  crc.update(bytes);
  return crc.value();
}

}  // namespace

void Writer::FreeContext::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

void Writer::Extent::add(std::uint64_t time_ns) {
  first_ns = is_empty ? time_ns : std::min(first_ns, time_ns);
  last_ns = is_empty ? time_ns : std::max(last_ns, time_ns);
  is_empty = false;
}

Writer::Writer(const std::string& path, std::string_view profile, Compression compression)
    : path_(path), place_(path), compression_(compression), context_(ZSTD_createCCtx()) {
  errno = 0;
  file_.open(place_.path(), std::ios::binary);
  if (!file_) {
    throw file_error(path, "cannot be written");
  }
  append(std::as_bytes(std::span(kMagic)));
  RecordBytes header;
  header.put(profile);
  header.put(std::string_view("iogrid"));
  append(OpCode::kHeader, header);
}

std::uint16_t Writer::add_schema(const Schema& schema) {
  ++schema_count_;
  RecordBytes record;
  record.put(schema_count_);
  record.put(std::string_view(schema.name));
  record.put(std::string_view(schema.encoding));
  record.put(std::string_view(schema.text));
  schemas_.put(OpCode::kSchema, record.view());
  chunk_.put(OpCode::kSchema, record.view());
  return schema_count_;
}

std::uint16_t Writer::add_channel(const Channel& channel) {
  require(channel.schema_id <= schema_count_);
  ++channel_count_;
  RecordBytes record;
  record.put(channel_count_);
  record.put(channel.schema_id);
  record.put(std::string_view(channel.topic));
  record.put(std::string_view(channel.message_encoding));
  record.put(channel.metadata);
  channels_.put(OpCode::kChannel, record.view());
  chunk_.put(OpCode::kChannel, record.view());
  message_counts_[channel_count_] = 0;
  return channel_count_;
}

void Writer::write(std::uint16_t channel_id, const Times& times, std::span<const std::byte> data) {
  require(channel_id > 0 && channel_id <= channel_count_);
  index_[channel_id].emplace_back(times.log_ns, chunk_.size());
  chunk_.put(static_cast<std::uint8_t>(OpCode::kMessage));
  chunk_.put(std::uint64_t{kMessageHeadBytes + data.size()});
  chunk_.put(channel_id);
  chunk_.put(message_counts_[channel_id]++);
  chunk_.put(times.log_ns);
  chunk_.put(times.publish_ns);
  chunk_.put(data);
  chunk_extent_.add(times.log_ns);
  extent_.add(times.log_ns);
  if (chunk_.size() >= kChunkBytes || chunk_extent_.last_ns - chunk_extent_.first_ns >= kChunkNs) {
    end_chunk();
  }
}

void Writer::finish(std::string_view metadata_name, const Metadata& metadata) {
  if (chunk_.size() > 0) {
    end_chunk();
  }
  append_metadata(metadata_name, metadata);
  RecordBytes end;
  end.put(crc_.value());
  append(OpCode::kDataEnd, end);
  append_summary();
  append(std::as_bytes(std::span(kMagic)));
  errno = 0;
  file_.close();
  if (!file_) {
    throw file_error(path_, "not written completely");
  }
  place_.finish();
}

void Writer::append(std::span<const std::byte> bytes) {
  errno = 0;
  if (!file_.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()))) {
    throw file_error(path_, "cannot be written any more");
  }
  crc_.update(bytes);
  position_ += bytes.size();
}

void Writer::append(OpCode code, const RecordBytes& content) {
  RecordBytes record;
  record.put(code, content.view());
  append(record.view());
}

void Writer::end_chunk() {
  const std::span<const std::byte> records = compressed_chunk();
  const std::uint64_t chunk_start = position_;
  append_chunk(records);
  const std::uint64_t chunk_end = position_;
  const auto index_offsets = append_message_indexes();
  RecordBytes entry;
  entry.put(chunk_extent_.first_ns);
  entry.put(chunk_extent_.last_ns);
  entry.put(chunk_start);
  entry.put(chunk_end - chunk_start);
  entry.put(static_cast<std::uint32_t>(index_offsets.size() * (2 + 8)));
  for (const auto& [channel_id, offset] : index_offsets) {
    entry.put(channel_id);
    entry.put(offset);
  }
  entry.put(position_ - chunk_end);
  entry.put(name_of(compression_));
  entry.put(std::uint64_t{records.size()});
  entry.put(std::uint64_t{chunk_.size()});
  chunk_indexes_.put(OpCode::kChunkIndex, entry.view());
  ++chunk_count_;
  chunk_.clear();
  index_.clear();
  chunk_extent_ = {};
  errno = 0;
  if (!file_.flush()) {
    throw file_error(path_, "cannot be written any more");
  }
}

std::span<const std::byte> Writer::compressed_chunk() {
  if (compression_ == Compression::kNone) {
    return chunk_.view();
  }
  compressed_.resize(ZSTD_compressBound(chunk_.size()));
  const std::size_t bytes =
      ZSTD_compressCCtx(context_.get(), compressed_.data(), compressed_.size(),
                        chunk_.view().data(), chunk_.size(), kZstdLevel);
  require(ZSTD_isError(bytes) == 0);
  return std::span(compressed_).first(bytes);
}

void Writer::append_chunk(std::span<const std::byte> records) {
  RecordBytes content;
  content.put(chunk_extent_.first_ns);
  content.put(chunk_extent_.last_ns);
  content.put(std::uint64_t{chunk_.size()});
  content.put(crc_of(chunk_.view()));
  content.put(name_of(compression_));
  content.put(std::uint64_t{records.size()});
  content.put(records);
  append(OpCode::kChunk, content);
}

// Readers expect the entries of an index in the order of time.
std::map<std::uint16_t, std::uint64_t> Writer::append_message_indexes() {
  std::map<std::uint16_t, std::uint64_t> offsets;
  for (auto& [channel_id, entries] : index_) {
    offsets[channel_id] = position_;
    std::ranges::stable_sort(entries, {}, &Index::value_type::first);
    RecordBytes content;
    content.put(channel_id);
    content.put(static_cast<std::uint32_t>(entries.size() * (8 + 8)));
    for (const auto& [log_ns, offset] : entries) {
      content.put(log_ns);
      content.put(offset);
    }
    append(OpCode::kMessageIndex, content);
  }
  return offsets;
}

void Writer::append_metadata(std::string_view name, const Metadata& metadata) {
  const std::uint64_t start = position_;
  RecordBytes content;
  content.put(name);
  content.put(metadata);
  append(OpCode::kMetadata, content);
  RecordBytes entry;
  entry.put(start);
  entry.put(position_ - start);
  entry.put(name);
  metadata_indexes_.put(OpCode::kMetadataIndex, entry.view());
  ++metadata_count_;
}

// Groups of records of one kind, where each group is, and the footer that says where these begin.
void Writer::append_summary() {
  RecordBytes statistics_record;
  statistics_record.put(OpCode::kStatistics, statistics().view());
  const std::uint64_t summary_start = position_;
  RecordBytes section;
  RecordBytes offsets;
  for (const auto& [code, group] : {std::pair{OpCode::kSchema, &schemas_},
                                    {OpCode::kChannel, &channels_},
                                    {OpCode::kStatistics, &statistics_record},
                                    {OpCode::kChunkIndex, &chunk_indexes_},
                                    {OpCode::kMetadataIndex, &metadata_indexes_}}) {
    if (group->size() == 0) {
      continue;
    }
    RecordBytes offset;
    offset.put(static_cast<std::uint8_t>(code));
    offset.put(summary_start + section.size());
    offset.put(std::uint64_t{group->size()});
    offsets.put(OpCode::kSummaryOffset, offset.view());
    section.put(group->view());
  }
  const std::uint64_t offsets_start = summary_start + section.size();
  section.put(offsets.view());
  section.put(static_cast<std::uint8_t>(OpCode::kFooter));
  section.put(std::uint64_t{kFooterBytes});
  section.put(summary_start);
  section.put(offsets_start);
  section.put(crc_of(section.view()));
  append(section.view());
}

RecordBytes Writer::statistics() const {
  RecordBytes counts;
  std::uint64_t messages = 0;
  for (const auto& [channel_id, count] : message_counts_) {
    counts.put(channel_id);
    counts.put(std::uint64_t{count});
    messages += count;
  }
  RecordBytes content;
  content.put(messages);
  content.put(schema_count_);
  content.put(std::uint32_t{channel_count_});
  content.put(std::uint32_t{0});  // attachments
  content.put(metadata_count_);
  content.put(chunk_count_);
  content.put(extent_.first_ns);
  content.put(extent_.last_ns);
  content.put(static_cast<std::uint32_t>(counts.size()));
  content.put(counts.view());
  return content;
}

}  // namespace iog::tools::mcap
