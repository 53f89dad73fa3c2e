// What one client has asked for, and what it is told of requests that cannot be met.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/foxglove/protocol.hpp"

namespace iog::tools::foxglove {

class Subscriptions {
 public:
  // Statuses for the client, none if all is well: at most kMostAnswers, however much is wrong.
  static constexpr std::size_t kMostAnswers = 8;
  using Answers = std::vector<std::string>;

  // A text of the client, of whatever bytes. channels: that there are.
  [[nodiscard]] Answers take_text(std::string_view text, std::span<const Channel> channels);
  // A binary message: clients may send none, because this server has no use for any.
  [[nodiscard]] static Answers take_binary(std::span<const std::byte> message);

  // The channel is no more, and neither is its subscription.
  void forget(std::uint32_t channel_id);

  // The id that the client has given to its subscription of a channel; nothing if it has none.
  [[nodiscard]] std::optional<std::uint32_t> of_channel(std::uint32_t channel_id) const;
  [[nodiscard]] bool is_empty() const { return by_channel_.empty(); }

 private:
  class Request;

  void subscribe(Request& request, std::span<const Channel> channels);
  void unsubscribe(Request& request);

  std::map<std::uint32_t, std::uint32_t> by_channel_;  // never more than there are channels
};

}  // namespace iog::tools::foxglove
