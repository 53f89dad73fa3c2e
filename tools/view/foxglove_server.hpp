// Serves what is shown to Foxglove and what speaks its WebSocket protocol (docs/foxglove.md), on a
// thread of its own.
//
// A request is let in only if its Host is `localhost` or an IP address, and if it comes from a
// program, from a page of this PC or from Foxglove's own: no other page of the internet can read
// along.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "tools/foxglove/live_feed.hpp"

namespace iog::tools::view {

class FoxgloveServer {
 public:
  // As WebServer. The feed outlives the server. on_client: called on the server's thread whenever a
  // client has come.
  FoxgloveServer(const std::string& address, std::uint16_t port, foxglove::LiveFeed& feed,
                 std::function<void()> on_client);
  ~FoxgloveServer();
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace iog::tools::view
