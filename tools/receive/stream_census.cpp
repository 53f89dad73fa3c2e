#include "tools/receive/stream_census.hpp"

#include "tools/receive/link_counts.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
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

Facts StreamCensus::facts() const {
  Facts facts = statistics_.facts();
  facts.emplace_back("vehicle", vehicle());
  for (const auto& [name, count] : link_counts(assembler_)) {
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
  text += rows_of(link_counts(assembler_));
  if (const auto version = assembler_.version_sent()) {
    text += row("target sends", words_of_version(*version));
  }
  if (const auto& refusal = assembler_.car_refusal()) {
    text += row("car refused", *refusal);
  }
  return text;
}

std::string StreamCensus::vehicle() const {
  if (!last_) {
    return {};
  }
  return words_of_vehicle(last_->vehicle_id);
}

}  // namespace iog::tools
