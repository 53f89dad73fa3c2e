#include "tools/info/file_summary.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "tools/clouds/ros_clouds.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/mcap/reader.hpp"
#include "tools/formats/ros/bag_files.hpp"
#include "tools/formats/ros/sqlite_bag.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/info/capture_census.hpp"
#include "tools/info/cloud_census.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/stream_census.hpp"
#include "tools/record/mcap_recording.hpp"
#include "tools/record/stream_file.hpp"

namespace iog::tools {
namespace {

// A stream takes some megabytes of memory. A car has one.
constexpr std::size_t kMaxStreams = 8;

struct TopicCensus {
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
  std::uint64_t first_ns = UINT64_MAX;
  std::uint64_t last_ns = 0;
};

std::string count_row(const std::string& name, std::uint64_t count, const std::string& what) {
  return count > 0 ? row(name, std::to_string(count) + what) : std::string();
}

// ", 10.0 Hz over 59.9 s"; empty of one message.
std::string rate_of(std::uint64_t messages, double duration_s) {
  if (messages < 2 || duration_s <= 0) {
    return {};
  }
  return ", " + fixed(static_cast<double>(messages - 1) / duration_s, 1) + " Hz over " +
         fixed(duration_s, 1) + " s";
}

std::string topics_of(const mcap::Reader& file,
                      const std::map<std::uint16_t, TopicCensus>& census) {
  std::ostringstream text;
  for (const auto& [id, channel] : file.channels()) {
    const auto schema = file.schemas().find(channel.schema_id);
    const auto found = census.find(id);
    const TopicCensus topic = found != census.end() ? found->second : TopicCensus{};
    text << "  " << std::left << std::setw(20) << printable(channel.topic) << ' '
         << counted(topic.messages, "message|messages, ") << topic.bytes << " bytes";
    const auto duration_ns = static_cast<double>(topic.last_ns - topic.first_ns);
    text << rate_of(topic.messages, duration_ns / 1e9) << ", "
         << (schema != file.schemas().end() ? printable(schema->second.name) : "no schema") << ", "
         << printable(channel.message_encoding) << '\n';
  }
  return text.str();
}

// What an MCAP file holds.
struct McapCensus {
  std::map<std::uint16_t, TopicCensus> topics;
  StreamCensus stream;
  std::uint64_t first_ns = UINT64_MAX;
  std::uint64_t last_ns = 0;

  void add(const mcap::Message& message, bool is_of_stream) {
    TopicCensus& topic = topics[message.channel_id];
    ++topic.messages;
    topic.bytes += message.data.size();
    topic.first_ns = std::min(topic.first_ns, message.log_ns);
    topic.last_ns = std::max(topic.last_ns, message.log_ns);
    first_ns = std::min(first_ns, message.log_ns);
    last_ns = std::max(last_ns, message.log_ns);
    if (const auto datagram =
            is_of_stream ? ros::bytes_of_uint8_multi_array(message.data) : std::nullopt) {
      stream.take(*datagram);
    }
  }

  [[nodiscard]] std::uint64_t duration_us() const {
    return topics.empty() ? 0 : (last_ns - first_ns) / 1000;
  }
};

// By the messages themselves; where they are not in the file, by what the recorder says of them.
std::string stream_of(const mcap::Reader& file, const McapCensus& census) {
  const FrameAssembler& assembler = census.stream.assembler();
  if (assembler.counts().messages > 0 || assembler.version_sent()) {
    return row("\nstream on", std::string(kMessagesTopic)) + census.stream.table();
  }
  const auto run = file.metadata().find(std::string(kRunMetadata));
  if (run == file.metadata().end()) {
    return {};
  }
  std::string text = "\nwithout the messages themselves; their recorder says:\n";
  for (const auto& [name, value] : run->second) {
    text += row(printable(name), printable(value));
  }
  return text;
}

// How the file ends, and what of it is damaged.
std::string condition_of(const mcap::Reader& file) {
  const mcap::ReadCounts& counts = file.counts();
  const bool has_index = counts.chunk_index_entries > 0;
  std::string text = row("condition", !file.is_finished() ? "breaks off: no index at its end"
                                      : has_index         ? "whole, with an index"
                                                          : "whole, without an index");
  if (file.is_finished() && has_index && counts.chunk_index_entries != counts.chunks) {
    text += row("index", std::to_string(counts.chunk_index_entries) + " chunks of " +
                             std::to_string(counts.chunks));
  }
  if (file.promised_messages().value_or(counts.messages) != counts.messages) {
    text += row("missing", "the file speaks of " +
                               counted(*file.promised_messages(), "message|messages, ") +
                               std::to_string(counts.messages) + " can be read");
  }
  return text + count_row("broken chunks", counts.broken_chunks, "") +
         count_row("unreadable chunks", counts.unreadable_chunks,
                   ", compressed otherwise than by zstd, or too large") +
         count_row("malformed records", counts.malformed, "") +
         count_row("behind its end", counts.behind_end, " bytes, not read");
}

// Sets has_clouds if it has clouds that iog did not write; describes them itself if it is alone.
std::string words_of_mcap(const std::string& path, bool is_alone, bool& has_clouds) {
  std::ifstream stream(path, std::ios::binary);
  mcap::Reader file(stream);
  const auto census = std::make_unique<McapCensus>();
  Progress progress("messages");
  while (const std::optional<mcap::Message> message = file.next()) {
    census->add(*message, file.channels().at(message->channel_id).topic == kMessagesTopic);
    progress.show(file.counts().messages, file.part_read());
  }
  census->stream.finish();
  const std::uint64_t duration_us = census->duration_us();
  const bool is_of_ros = std::ranges::any_of(
      file.schemas(), [](const auto& schema) { return is_cloud_type(schema.second.name); });
  const bool is_ours = file.metadata().contains(std::string(kRunMetadata));
  has_clouds = has_clouds || (is_of_ros && !is_ours);
  const std::string clouds = has_clouds && is_alone ? describe_clouds(path) : "";
  const std::string compression =
      file.compression().empty() ? "none" : printable(file.compression());
  return row("kind", "MCAP, " + seconds(duration_us)) +
         row("written by", printable(file.library())) + row("profile", printable(file.profile())) +
         row("chunks", std::to_string(file.counts().chunks) + ", compression " + compression) +
         condition_of(file) + row("topics", std::to_string(file.channels().size())) +
         topics_of(file, census->topics) + clouds + stream_of(file, *census);
}

}  // namespace

std::string seconds(std::uint64_t micros) {
  return fixed(static_cast<double>(micros) / 1e6, 3) + " s";
}

std::string summary_of_file(const std::string& path) {
  if (ros::is_recording(path) && !path.ends_with(".mcap") && !is_mcap_file(path)) {
    return summary_of_bag(path);
  }
  if (std::filesystem::is_directory(path)) {
    return summary_of_folder(path);
  }
  if (is_mcap_file(path)) {
    return summary_of_mcap(path);
  }
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, sizeof magic);
  if (magic[0] == 'P' && magic[1] == '5') {
    return summary_of_pgm(path);
  }
  if (is_block_file(path)) {
    return summary_of_block_file(path);
  }
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix == ".yaml" || suffix == ".yml" ? summary_of_map(path) : summary_of_capture(path);
}

std::string summary_of_capture(const std::string& path) {
  PcapReader capture(path);
  CaptureCensus census;
  CaptureIdentity identity;
  std::map<std::uint16_t, StreamCensus> streams;  // by port
  std::optional<std::uint64_t> first_us;
  std::uint64_t last_us = 0;
  Progress progress("packets");
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    census.add(*datagram);
    identity.add(*datagram);
    const bool is_looked_into =
        streams.size() < kMaxStreams || streams.contains(datagram->destination.port);
    if (is_looked_into && StreamCensus::is_message(datagram->payload)) {
      streams[datagram->destination.port].take(datagram->payload);
    }
    first_us = first_us.value_or(datagram->time_us);
    last_us = std::max(last_us, datagram->time_us);
    progress.show(capture.counts().datagrams, capture.part_read());
  }
  std::string text = row("kind", "capture, " + seconds(last_us - first_us.value_or(last_us)));
  text += census.table();
  if (const std::string words = identity.words_of_best(); !words.empty()) {
    text += row("looks like", words);
  }
  if (const std::string skipped = describe_skipped(capture.counts()); !skipped.empty()) {
    text += skipped + "\n";
  }
  if (!capture.trouble().empty()) {
    text += "the file " + capture.trouble() + "\n";
  }
  if (const std::string words = capture.clock_words(); !words.empty()) {
    text += words + "\n";
  }
  for (auto& [port, stream] : streams) {
    stream.finish();
    text += row("\nstream to port", std::to_string(port)) + stream.table();
  }
  return text;
}

std::string summary_of_mcap(const std::string& path) {
  bool has_clouds = false;
  return words_of_mcap(path, true, has_clouds);
}

// Its files one by one, and the clouds of all of them.
std::string summary_of_bag(const std::string& path) {
  const std::vector<std::string> names = ros::files_of_recording(path);
  std::string text = row("kind", "bag of ROS 2, " + counted(names.size(), "file|files"));
  bool has_clouds = false;
  for (const std::string& name : names) {
    text += name + '\n';
    const ros::PlainFile plain(name);
    if (is_mcap_file(plain.path())) {
      text += words_of_mcap(plain.path(), false, has_clouds);
      continue;
    }
    for (const ros::BagTopic& topic : ros::topics_in_sqlite(plain.path(), name)) {
      const double duration_s = static_cast<double>(topic.duration_ns) / 1e9;
      text += "  " + printable(topic.name) + ' ' + counted(topic.messages, "message|messages") +
              rate_of(topic.messages, duration_s) + ", " + printable(topic.type) + ", " +
              printable(topic.encoding) + '\n';
      has_clouds = has_clouds || is_cloud_type(topic.type);
    }
  }
  text += has_clouds ? describe_clouds(path) : "";
  for (const std::string& words : ros::remarks_on_files(path)) {
    text += words + '\n';
  }
  return text;
}

}  // namespace iog::tools
