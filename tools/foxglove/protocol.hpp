// What a server says in the Foxglove WebSocket protocol, version 1, as far as it has none of the
// optional capabilities: https://github.com/foxglove/ws-protocol, docs/spec.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tools/formats/ros/grid_messages.hpp"

namespace iog::tools::foxglove {

// Sub-protocols of the handshake: of the specification, and what Foxglove's later programs call the
// same.
inline constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.websocket.v1",
                                                               "foxglove.sdk.v1"};

// A topic, as the clients know it.
struct Channel {
  std::uint32_t id = 0;
  std::string_view topic;
  const ros::MessageType* type = nullptr;
};

enum class Level : std::uint8_t { kInfo, kWarning, kError };

// Text messages, JSON. session: another one in each run of this program.
[[nodiscard]] std::string server_info(std::string_view name, std::string_view session);
[[nodiscard]] std::string advertise(std::span<const Channel> channels);
[[nodiscard]] std::string unadvertise(std::span<const Channel> channels);
// id: of the one that it takes the place of, where the client keeps them; may be empty.
[[nodiscard]] std::string status(Level level, std::string_view words, std::string_view id = {});

// What is before the bytes of a message in a binary message.
using MessageHead = std::array<std::byte, 13>;
[[nodiscard]] MessageHead message_head(std::uint32_t subscription, std::uint64_t arrival_ns);

}  // namespace iog::tools::foxglove
