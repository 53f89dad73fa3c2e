#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/mcap/reader.hpp"
#include "tools/formats/mcap/record_bytes.hpp"
#include "tools/formats/mcap/writer.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools::mcap {
namespace {

constexpr std::uint64_t kSecondNs = 1'000'000'000;

struct Kept {
  std::uint16_t channel_id;
  std::uint32_t sequence;
  std::uint64_t log_ns;
  std::uint64_t publish_ns;
  std::vector<std::byte> data;

  friend bool operator==(const Kept&, const Kept&) = default;
};

std::vector<std::byte> data_of(std::size_t bytes) {
  std::vector<std::byte> data;
  for (std::size_t i = 0; i < bytes; ++i) {
    data.push_back(static_cast<std::byte>(i * 31 + bytes));
  }
  return data;
}

// Messages of two channels, four in each second, in chunks of a second.
std::vector<Kept> sample_messages(std::uint32_t count) {
  std::vector<Kept> messages;
  for (std::uint32_t i = 0; i < count; ++i) {
    messages.push_back({.channel_id = static_cast<std::uint16_t>(1 + i % 2),
                        .sequence = i / 2,
                        .log_ns = 5 * kSecondNs + i * kSecondNs / 4,
                        .publish_ns = i,
                        .data = data_of(i * 7 % 100)});
  }
  return messages;
}

std::string file_of(const std::vector<Kept>& messages, Compression compression) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "messages.mcap";
  Writer writer(path, "ros2", compression);
  const std::uint16_t schema =
      writer.add_schema({.name = "a/msg/B", .encoding = "ros2msg", .text = "uint8 c"});
  for (const char* const topic : {"/one", "/two"}) {
    writer.add_channel({.schema_id = schema,
                        .topic = topic,
                        .message_encoding = "cdr",
                        .metadata = {{"key", "value"}, {"other", ""}}});
  }
  for (const Kept& message : messages) {
    writer.write(message.channel_id, {.log_ns = message.log_ns, .publish_ns = message.publish_ns},
                 message.data);
  }
  writer.finish("run", {{"frames", "17"}});
  const std::vector<std::byte> bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<Kept> all_of(Reader& reader) {
  std::vector<Kept> messages;
  while (const std::optional<Message> message = reader.next()) {
    messages.push_back({.channel_id = message->channel_id,
                        .sequence = message->sequence,
                        .log_ns = message->log_ns,
                        .publish_ns = message->publish_ns,
                        .data = {message->data.begin(), message->data.end()}});
  }
  return messages;
}

std::uint64_t u64_at(const std::string& file, std::size_t at) {
  return wire::load_le64(std::as_bytes(std::span(file)).subspan(at).first<8>());
}

class Mcap : public testing::TestWithParam<Compression> {};
INSTANTIATE_TEST_SUITE_P(Plain, Mcap, testing::Values(Compression::kNone));
INSTANTIATE_TEST_SUITE_P(Compressed, Mcap, testing::Values(Compression::kZstd));

TEST_P(Mcap, WhatIsWrittenIsReadBack) {
  const std::vector<Kept> messages = sample_messages(23);
  std::istringstream in(file_of(messages, GetParam()));
  Reader reader(in);
  EXPECT_EQ(all_of(reader), messages);
  EXPECT_TRUE(reader.is_finished());
  EXPECT_EQ(reader.profile(), "ros2");
  EXPECT_EQ(reader.channels().at(2).topic, "/two");
  EXPECT_EQ(reader.channels().at(1).metadata, (Metadata{{"key", "value"}, {"other", ""}}));
  EXPECT_EQ(reader.schemas().at(1).text, "uint8 c");
  EXPECT_EQ(reader.metadata().at("run"), (Metadata{{"frames", "17"}}));
  EXPECT_EQ(reader.promised_messages(), messages.size());
  EXPECT_EQ(reader.counts().chunk_index_entries, reader.counts().chunks);
  EXPECT_EQ(reader.counts().broken_chunks + reader.counts().malformed, 0U);
}

// A place is that of a chunk: of a second here, four messages.
TEST_P(Mcap, GoesOnFromThePlaceOfAnyMessage) {
  const std::vector<Kept> messages = sample_messages(23);
  std::istringstream in(file_of(messages, GetParam()));
  Reader reader(in);
  std::vector<std::uint64_t> places;
  while (reader.next()) {
    places.push_back(reader.place());
  }
  ASSERT_EQ(places.size(), messages.size());
  for (const std::size_t from : {22U, 4U, 0U, 11U}) {
    reader.go_to(places.at(from));
    const std::vector<Kept> rest = all_of(reader);
    ASSERT_GE(rest.size(), messages.size() - from);
    ASSERT_LT(rest.size(), messages.size() - from + 5);
    EXPECT_TRUE(
        std::ranges::equal(rest, std::span(messages).subspan(messages.size() - rest.size())));
    EXPECT_TRUE(reader.is_finished());
  }
}

TEST_P(Mcap, AFileWithoutMessagesIsWhole) {
  std::istringstream in(file_of({}, GetParam()));
  Reader reader(in);
  EXPECT_TRUE(all_of(reader).empty());
  EXPECT_TRUE(reader.is_finished());
  EXPECT_EQ(reader.channels().size(), 2U);
}

// What a recorder that was killed leaves.
TEST_P(Mcap, AFileThatBreaksOffIsReadUpToItsLastWholeChunk) {
  const std::vector<Kept> messages = sample_messages(23);
  const std::string file = file_of(messages, GetParam());
  std::size_t most = 0;
  for (std::size_t bytes = kMagic.size(); bytes < file.size(); ++bytes) {
    std::istringstream in(file.substr(0, bytes));
    Reader reader(in);
    const std::vector<Kept> read = all_of(reader);
    EXPECT_FALSE(reader.is_finished());
    ASSERT_LE(read.size(), messages.size());
    EXPECT_TRUE(std::equal(read.begin(), read.end(), messages.begin()));
    EXPECT_GE(read.size(), most) << "more bytes, fewer messages";
    most = read.size();
  }
  EXPECT_EQ(most, messages.size());
}

TEST_P(Mcap, AChunkWithAChangedBitIsLeftOutAndCounted) {
  const std::vector<Kept> messages = sample_messages(23);
  std::string file = file_of(messages, GetParam());
  std::istringstream whole(file);
  Reader counter(whole);
  static_cast<void>(all_of(counter));
  file[file.size() / 4] = static_cast<char>(file[file.size() / 4] ^ 0x10);
  std::istringstream in(file);
  Reader reader(in);
  const std::vector<Kept> read = all_of(reader);
  EXPECT_EQ(reader.counts().broken_chunks + reader.counts().malformed, 1U);
  EXPECT_LT(read.size(), messages.size());
  EXPECT_GE(read.size(), messages.size() - 5);
  EXPECT_TRUE(reader.is_finished());
}

// https://mcap.dev/spec: header behind the magic; before the magic at the end a footer of 20 bytes
// with the place of the summary and of the summary offsets.
TEST_P(Mcap, BeginningAndEndAreAsSpecified) {
  const std::string file = file_of(sample_messages(3), GetParam());
  const std::string magic = "\x89MCAP0\r\n";
  EXPECT_EQ(file.substr(0, 8), magic);
  EXPECT_EQ(file.substr(file.size() - 8), magic);
  EXPECT_EQ(file.substr(8, 9), std::string("\x01\x12\0\0\0\0\0\0\0", 9));
  EXPECT_EQ(file.substr(17, 18), std::string("\4\0\0\0ros2\6\0\0\0iogrid", 18));
  const std::size_t footer = file.size() - 8 - 20;
  EXPECT_EQ(file[footer - 9], '\x02');
  EXPECT_EQ(u64_at(file, footer - 8), 20U);
  const std::uint64_t summary = u64_at(file, footer);
  const std::uint64_t offsets = u64_at(file, footer + 8);
  EXPECT_EQ(file[summary], '\x03') << "schemas first";
  EXPECT_EQ(file[summary - 13], '\x0F') << "data end before it";
  EXPECT_EQ(file[offsets], '\x0E');
}

TEST_P(Mcap, TheSameMessagesGiveTheSameBytes) {
  EXPECT_EQ(file_of(sample_messages(23), GetParam()), file_of(sample_messages(23), GetParam()));
}

TEST(McapReader, WhatIsNoMcapFileIsRefused) {
  for (const std::string& file :
       {std::string(), std::string("\x89MCAP1\r\n"), std::string(100, 'x')}) {
    std::istringstream in(file);
    EXPECT_THROW(Reader{in}, UsageError);
  }
}

// A length of 2^63 does not make the reader wait for so much or ask for so much memory.
// A file may have more bytes than the PC has memory: this one has a hole.
TEST(McapReader, ARecordOfHundredsOfMegabytesIsPassedOver) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "large.mcap";
  {
    std::ofstream out(path, std::ios::binary);
    const auto put = [&](const RecordBytes& bytes) {
      out.write(reinterpret_cast<const char*>(bytes.view().data()),
                static_cast<std::streamsize>(bytes.size()));
    };
    constexpr std::uint64_t kBytes = 300U << 20;
    RecordBytes head;
    head.put(std::as_bytes(std::span(kMagic)));
    head.put(static_cast<std::uint8_t>(OpCode::kChunk));
    head.put(kBytes);
    put(head);
    out.seekp(static_cast<std::streamoff>(kBytes), std::ios::cur);
    RecordBytes end;
    end.put(OpCode::kFooter, std::vector<std::byte>(kFooterBytes));
    end.put(std::as_bytes(std::span(kMagic)));
    put(end);
  }
  std::ifstream file(path, std::ios::binary);
  Reader reader(file);
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.is_finished());
  EXPECT_EQ(reader.counts().unreadable_chunks, 1U);
}

TEST(McapReader, ARecordLongerThanTheFileEndsIt) {
  std::string file(reinterpret_cast<const char*>(kMagic.data()), kMagic.size());
  file += std::string("\x01\0\0\0\0\0\0\0\x80", 9) + std::string(50, 'x');
  std::istringstream in(file);
  Reader reader(in);
  EXPECT_EQ(reader.next(), std::nullopt);
  EXPECT_FALSE(reader.is_finished());
}

}  // namespace
}  // namespace iog::tools::mcap
