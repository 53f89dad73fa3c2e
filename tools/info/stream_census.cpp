#include "tools/info/stream_census.hpp"

#include <algorithm>

#include "tools/catalogue/vehicle_catalogue.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {

StreamCensus::StreamCensus(FrameHandler on_frame)
    : on_frame_(std::move(on_frame)), assembler_([this](const GridFrame& frame) {
        statistics_.add(frame);
        last_ = frame.header;
        if (on_frame_) {
          on_frame_(frame);
        }
      }) {}

bool StreamCensus::is_message(std::span<const std::byte> datagram) {
  wire::ByteReader in(datagram);
  const std::uint16_t service = in.u16_be();
  const std::uint16_t event = in.u16_be();
  return in.ok() && service == stream::kServiceId &&
         event == stream::kNetworkChannel.event.event_id;
}

RunStatistics::Facts StreamCensus::facts() const {
  RunStatistics::Facts facts = statistics_.facts();
  facts.emplace_back("vehicle", vehicle());
  for (const auto& [name, count] : message_counts()) {
    facts.emplace_back(name, std::to_string(count));
  }
  return facts;
}

std::string StreamCensus::table() const {
  std::string text;
  if (last_) {
    text += row("vehicle", vehicle());
  }
  text += statistics_.table(true);
  for (const auto& [name, count] : message_counts()) {
    if (count > 0 || name == "messages" || name == "messages_lost") {
      std::string words = name;
      std::ranges::replace(words, '_', ' ');
      text += row(words, std::to_string(count));
    }
  }
  return text;
}

std::string StreamCensus::vehicle() const {
  if (!last_) {
    return {};
  }
  const CatalogueEntry* const car = vehicle_of_id(last_->vehicle_id);
  return car != nullptr ? std::string(car->vehicle->name)
                        : "unknown (" + hex(last_->vehicle_id) + ")";
}

std::vector<std::pair<std::string, std::uint64_t>> StreamCensus::message_counts() const {
  const MessageCounts& counts = assembler_.counts();
  return {{"messages", counts.messages},
          {"message_bytes", counts.bytes},
          {"messages_lost", assembler_.messages_lost()},
          {"frames_lost", assembler_.frames_lost()},
          {"messages_late", counts.late},
          {"messages_repeated", counts.repeated},
          {"messages_too_late", counts.too_late},
          {"messages_corrupt", counts.corrupt},
          {"messages_malformed", counts.malformed},
          {"messages_not_ours", counts.not_ours},
          {"messages_other_version", counts.other_version},
          {"messages_not_understood", counts.not_understood},
          {"tiles_without_reference", counts.without_reference},
          {"target_restarts", counts.restarts}};
}

}  // namespace iog::tools
