#include "tools/foxglove/protocol.hpp"

#include <nlohmann/json.hpp>

#include "tools/record/topic_messages.hpp"

namespace iog::tools::foxglove {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::byte kMessageData{1};

// Where a text is not UTF-8, as it may be in the name of a file, a character of replacement is.
std::string text_of(const OrderedJson& json) {
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

template <std::unsigned_integral Value>
std::byte* put(std::byte* out, Value value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    *out++ = static_cast<std::byte>(value >> 8 * i & 0xFF);
  }
  return out;
}

}  // namespace

std::string server_info(std::string_view name, std::string_view session) {
  return text_of({{"op", "serverInfo"},
                  {"name", name},
                  {"capabilities", OrderedJson::array()},
                  {"sessionId", session}});
}

std::string advertise(std::span<const Channel> channels) {
  OrderedJson list = OrderedJson::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", kMessageEncoding},
                    {"schemaName", channel.type->name},
                    {"schema", channel.type->definition},
                    {"schemaEncoding", kSchemaEncoding}});
  }
  return text_of({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string unadvertise(std::span<const Channel> channels) {
  OrderedJson list = OrderedJson::array();
  for (const Channel& channel : channels) {
    list.push_back(channel.id);
  }
  return text_of({{"op", "unadvertise"}, {"channelIds", std::move(list)}});
}

std::string status(Level level, std::string_view words, std::string_view id) {
  OrderedJson json{{"op", "status"}, {"level", static_cast<unsigned>(level)}, {"message", words}};
  if (!id.empty()) {
    json["id"] = id;
  }
  return text_of(json);
}

MessageHead message_head(std::uint32_t subscription, std::uint64_t arrival_ns) {
  MessageHead head{kMessageData};
  put(put(head.data() + 1, subscription), arrival_ns);
  return head;
}

}  // namespace iog::tools::foxglove
