#include "tools/formats/ros/recorded_messages.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <utility>

#include "tools/formats/mcap/reader.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools::ros {

void for_each_message(const std::string& path, std::initializer_list<std::string_view> types,
                      std::string_view topic,
                      const std::function<void(const RecordedMessage&)>& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw UsageError(path + ": there is no such file");
  }
  mcap::Reader reader(file);
  std::map<std::uint16_t, std::uint64_t> numbers;  // of messages of a channel
  while (const auto message = reader.next()) {
    const mcap::Channel& channel = reader.channels().at(message->channel_id);
    const auto schema = reader.schemas().find(channel.schema_id);
    if (schema == reader.schemas().end() ||
        std::ranges::find(types, schema->second.name) == types.end() ||
        (!topic.empty() && channel.topic != topic)) {
      continue;
    }
    std::string where = path + ": message " + std::to_string(numbers[message->channel_id]++) +
                        " of " + printable(channel.topic);
    if (channel.message_encoding != "cdr") {
      throw UsageError(where + ": its encoding is " + channel.message_encoding + ", not cdr");
    }
    take({channel.topic, schema->second.name, message->data, std::move(where)});
  }
  const std::uint64_t lost = reader.counts().unreadable_chunks + reader.counts().broken_chunks;
  if (lost > 0) {
    throw UsageError(path + ": " + std::to_string(lost) +
                     " chunks are damaged, or compressed by what is not read");
  }
}

}  // namespace iog::tools::ros
