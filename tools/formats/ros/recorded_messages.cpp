#include "tools/formats/ros/recorded_messages.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <utility>
#include <zstd.h>

#include "tools/formats/mcap/reader.hpp"
#include "tools/formats/ros/bag_files.hpp"
#include "tools/formats/ros/sqlite_bag.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools::ros {
namespace {

using namespace std::string_view_literals;

bool begins_with(std::span<const std::byte> bytes, std::string_view magic) {
  const auto expected = std::as_bytes(std::span(magic));
  return bytes.size() >= magic.size() && std::ranges::equal(bytes.first(magic.size()), expected);
}

// A message that rosbag2 has compressed by itself is a frame of zstd (RFC 8878), which no CDR
// begins as.
class Messages {
 public:
  Messages(std::span<const std::string_view> types, std::string_view topic,
           const std::function<void(const RecordedMessage&)>& take)
      : types_(types), topic_(topic), take_(&take) {}

  [[nodiscard]] bool wants(const BagTopic& topic) {
    const bool is_known = std::ranges::find(types_, topic.type) != types_.end();
    const bool is_meant = is_known && (topic_.empty() || topic.name == topic_);
    if (!is_meant) {
      (is_known ? others_ : all_).add(topic.name + " (" + topic.type + ')');
    }
    return is_meant;
  }

  // If what is meant has no message: the topics that have such messages, or else any.
  [[nodiscard]] std::string words_of_others() const {
    return !numbers_.empty() || (others_.is_empty() && all_.is_empty()) ? ""
           : others_.is_empty() ? "its topics are " + all_.words()
                                : "its topics of these types are " + others_.words();
  }

  void take(const std::string& file, const BagTopic& topic, std::span<const std::byte> data) {
    std::string where = file + ": message " + std::to_string(numbers_[topic.name]++) + " of " +
                        printable(topic.name);
    if (const auto& [name, type] = *types_of_.try_emplace(topic.name, topic.type).first;
        type != topic.type) {
      throw UsageError(where + ": it is of " + topic.type + ", and others of this topic of " +
                       type);
    }
    const std::string_view known = topic.type.starts_with("foxglove.") ? "protobuf" : "cdr";
    if (!topic.encoding.empty() && topic.encoding != known) {  // old bags do not say it
      throw UsageError(where + ": its encoding is " + printable(topic.encoding) + ", not " +
                       std::string(known));
    }
    (*take_)({topic.name, topic.type, unpacked(data, where), std::move(where)});
  }

 private:
  std::span<const std::byte> unpacked(std::span<const std::byte> data, const std::string& where) {
    if (!begins_with(data, "\x28\xB5\x2F\xFD"sv)) {
      return data;
    }
    constexpr unsigned long long kMostBytes = 256U << 20;
    const unsigned long long bytes = ZSTD_getFrameContentSize(data.data(), data.size());
    if (bytes <= kMostBytes) {
      unpacked_.resize(bytes);
      if (ZSTD_decompress(unpacked_.data(), bytes, data.data(), data.size()) == bytes) {
        return unpacked_;
      }
    }
    throw UsageError(where + ": what zstd has compressed is damaged, or larger than 256 MiB");
  }

  std::span<const std::string_view> types_;
  std::string_view topic_;
  const std::function<void(const RecordedMessage&)>* take_;
  std::map<std::string, std::uint64_t> numbers_;  // of a topic's messages
  std::map<std::string, std::string> types_of_;   // topics
  FewNames others_;                               // topics of these types that are not meant
  FewNames all_;                                  // of other types
  std::vector<std::byte> unpacked_;
};

void tell_lost(const std::string& name, std::uint64_t count, std::string_view what,
               std::vector<std::string>& remarks) {
  if (count > 0) {
    remarks.push_back(name + ": " + counted(count, what));
  }
}

void read_mcap(std::ifstream& file, const std::string& name, Messages& messages,
               std::vector<std::string>& remarks) {
  mcap::Reader reader(file);
  std::uint64_t without_schema = 0;
  while (const auto message = reader.next()) {
    const mcap::Channel& channel = reader.channels().at(message->channel_id);
    const auto schema = reader.schemas().find(channel.schema_id);
    if (schema == reader.schemas().end()) {
      without_schema += channel.schema_id == 0 ? 0U : 1U;  // 0: it has none, and is not of ROS 2
      continue;
    }
    if (channel.message_encoding == "ros1") {
      throw UsageError(
          name + ": messages of ROS 1: convert the bag first, for example by rosbags-convert");
    }
    const BagTopic topic{channel.topic, schema->second.name, channel.message_encoding, 0};
    if (messages.wants(topic)) {
      messages.take(name, topic, message->data);
    }
  }
  const mcap::ReadCounts& counts = reader.counts();
  if (counts.unreadable_chunks > 0 && !reader.compression().empty() &&
      reader.compression() != "zstd") {
    throw UsageError(name + ": its chunks are compressed by " + printable(reader.compression()) +
                     "; only zstd is read");
  }
  if (const std::uint64_t lost = counts.unreadable_chunks + counts.broken_chunks; lost > 0) {
    throw UsageError(name + ": " + counted(lost, "chunk|chunks is|are damaged or too large"));
  }
  const auto tell = [&](std::uint64_t count, std::string_view what) {
    tell_lost(name, count, what, remarks);
  };
  tell(counts.malformed, "malformed record|records was|were passed over");
  tell(without_schema, "message|messages has|have no known type");
  tell(counts.behind_end, "byte|bytes behind its end was|were not read");
  if (!reader.is_finished()) {
    remarks.push_back(name + ": its end is missing; it was read up to there");
  }
}

struct ReadFile {
  std::string name{};
  std::unique_ptr<PlainFile> plain{};
};

ReadFile& last_read() {
  static ReadFile last;
  return last;
}

const PlainFile& plain_file(const std::string& name) {
  ReadFile& last = last_read();
  if (!last.plain || last.name != name) {
    last = {};
    last = {name, std::make_unique<PlainFile>(name)};
  }
  return *last.plain;
}

}  // namespace

void forget_unpacked() { last_read() = {}; }

std::vector<std::string> for_each_message(const std::string& path,
                                          std::span<const std::string_view> types,
                                          std::string_view topic,
                                          const std::function<void(const RecordedMessage&)>& take) {
  Messages messages(types, topic, take);
  std::vector<std::string> remarks = remarks_on_files(path);
  for (const std::string& name : files_of_recording(path)) {
    const PlainFile& plain = plain_file(name);
    std::ifstream file(plain.path(), std::ios::binary);
    std::array<char, 16> magic{};
    file.read(magic.data(), magic.size());
    const auto begin =
        std::as_bytes(std::span(magic).first(static_cast<std::size_t>(file.gcount())));
    file.clear();
    if (begins_with(begin, "SQLite format 3\0"sv)) {
      const std::uint64_t lost = for_each_in_sqlite(
          plain.path(), name, [&](const BagTopic& its) { return messages.wants(its); },
          [&](const BagTopic& its, auto data) { messages.take(name, its, data); });
      tell_lost(name, lost, "message|messages has|have no known topic", remarks);
    } else if (begins_with(begin, "#ROSBAG V"sv)) {
      throw UsageError(name + ": a bag of ROS 1: convert it first, for example by rosbags-convert");
    } else if (begins_with(begin, "\x89MCAP0\r\n"sv)) {
      read_mcap(file, name, messages, remarks);
    } else {
      throw UsageError(name + ": neither MCAP nor a bag of SQLite");
    }
  }
  if (std::string words = messages.words_of_others(); !words.empty()) {
    remarks.push_back(std::move(words));
  }
  return remarks;
}

}  // namespace iog::tools::ros
