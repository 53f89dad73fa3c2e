#include "tools/foxglove/subscriptions.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace iog::tools::foxglove {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostEchoed = 40;  // characters of what a client has sent

// Requests of optional capabilities, and the capability.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kOptional{
    {{"advertise", "clientPublish"},
     {"unadvertise", "clientPublish"},
     {"getParameters", "parameters"},
     {"setParameters", "parameters"},
     {"subscribeParameterUpdates", "parametersSubscribe"},
     {"unsubscribeParameterUpdates", "parametersSubscribe"},
     {"subscribeConnectionGraph", "connectionGraph"},
     {"unsubscribeConnectionGraph", "connectionGraph"},
     {"fetchAsset", "assets"}}};

// "it", perhaps only the beginning of it.
std::string excerpt(std::string_view text) {
  return '"' + std::string(text.substr(0, kMostEchoed)) +
         (text.size() > kMostEchoed ? "…\"" : "\"");
}

std::string without(std::string_view operation, std::string_view capability) {
  return excerpt(operation) + ": this server has no capability " + excerpt(capability);
}

// A number of 32 bits; nothing if it is anything else, or missing.
std::optional<std::uint32_t> id_of(const Json& json) {
  if (!json.is_number_unsigned() ||
      json.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    return std::nullopt;
  }
  return json.get<std::uint32_t>();
}

std::optional<std::uint32_t> id_of(const Json& json, const char* key) {
  if (!json.is_object() || !json.contains(key)) {
    return std::nullopt;
  }
  return id_of(json[key]);
}

}  // namespace

// One of a client, and the answers to it.
class Subscriptions::Request {
 public:
  explicit Request(std::string_view text) : json_(Json::parse(text, nullptr, false)) {}

  // Empty if it is no object that names an operation.
  [[nodiscard]] std::string operation() const {
    const bool has_name = json_.is_object() && json_.contains("op") && json_["op"].is_string();
    return has_name ? json_["op"].get<std::string>() : std::string();
  }

  // The members of that list; says so if there is none.
  [[nodiscard]] const Json& list(const char* key) {
    static const Json none = Json::array();
    if (!json_.contains(key) || !json_[key].is_array()) {
      refuse(excerpt(operation()) + " has no list " + excerpt(key));
      return none;
    }
    return json_[key];
  }

  void refuse(std::string_view words) {
    if (answers_.size() + 1 < kMostAnswers) {
      answers_.push_back(status(Level::kError, words));
    } else {
      ++more_;
    }
  }

  [[nodiscard]] Answers take_answers() {
    if (more_ > 0) {
      answers_.push_back(
          status(Level::kError, std::to_string(more_) + " more of this request cannot be met"));
    }
    return std::move(answers_);
  }

 private:
  Json json_;
  Answers answers_;
  std::size_t more_ = 0;
};

Subscriptions::Answers Subscriptions::take_text(std::string_view text,
                                                std::span<const Channel> channels) {
  Request request(text);
  const std::string operation = request.operation();
  const auto optional =
      std::ranges::find(kOptional, operation, [](auto& each) { return each.first; });
  if (operation.empty()) {
    request.refuse("a message must be a JSON object with a text \"op\": " + excerpt(text));
  } else if (operation == "subscribe") {
    subscribe(request, channels);
  } else if (operation == "unsubscribe") {
    unsubscribe(request);
  } else if (optional != kOptional.end()) {
    request.refuse(without(operation, optional->second));
  } else {
    request.refuse(excerpt(operation) + " is no operation that is known here");
  }
  return request.take_answers();
}

Subscriptions::Answers Subscriptions::take_binary(std::span<const std::byte> message) {
  constexpr std::byte kClientMessage{1};
  constexpr std::byte kServiceCall{2};
  std::string words = "a binary message of an operation that is not known here";
  if (message.empty()) {
    words = "a binary message of no bytes";
  } else if (message.front() == kClientMessage) {
    words = without("message data", "clientPublish");
  } else if (message.front() == kServiceCall) {
    words = without("service call", "services");
  }
  return {status(Level::kError, words)};
}

void Subscriptions::subscribe(Request& request, std::span<const Channel> channels) {
  for (const Json& each : request.list("subscriptions")) {
    const std::optional<std::uint32_t> id = id_of(each, "id");
    const std::optional<std::uint32_t> channel = id_of(each, "channelId");
    if (!id || !channel) {
      request.refuse("a subscription needs an id and a channelId, each a whole number");
      continue;
    }
    const std::string name = "subscription " + std::to_string(*id) + ": ";
    const auto is_taken = [&](const auto& other) { return other.second == *id; };
    if (std::ranges::find(channels, *channel, &Channel::id) == channels.end()) {
      request.refuse(name + "there is no channel " + std::to_string(*channel));
    } else if (by_channel_.contains(*channel)) {
      request.refuse(name + "channel " + std::to_string(*channel) + " has a subscription already");
    } else if (std::ranges::any_of(by_channel_, is_taken)) {
      request.refuse(name + "this id is in use");
    } else {
      by_channel_[*channel] = *id;
    }
  }
}

void Subscriptions::unsubscribe(Request& request) {
  for (const Json& each : request.list("subscriptionIds")) {
    const std::optional<std::uint32_t> id = id_of(each);
    if (!id) {
      request.refuse("the id of a subscription is a whole number");
    } else if (std::erase_if(by_channel_, [&](const auto& one) { return one.second == *id; }) ==
               0) {
      request.refuse("there is no subscription " + std::to_string(*id));
    }
  }
}

void Subscriptions::forget(std::uint32_t channel_id) { by_channel_.erase(channel_id); }

std::optional<std::uint32_t> Subscriptions::of_channel(std::uint32_t channel_id) const {
  const auto found = by_channel_.find(channel_id);
  return found != by_channel_.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace iog::tools::foxglove
