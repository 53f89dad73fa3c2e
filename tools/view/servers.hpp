// Servers of this PC, each on a thread of its own. Port 0: any free one. UsageError if that address
// and port cannot be had.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "tools/foxglove/live_feed.hpp"
#include "tools/view/scene.hpp"

namespace iog::tools::view {

class Server {
 public:
  Server() = default;
  virtual ~Server() = default;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] virtual std::uint16_t port() const = 0;
};

// The page and the messages of a scene, for browsers. The scene outlives the server.
//
// A request is answered only if its Host is `localhost` or an IP address, and a WebSocket only if
// it is opened by a page of this very server: so no page of the internet can read along, neither
// directly nor by a name that it has pointed here (DNS rebinding).
[[nodiscard]] std::unique_ptr<Server> serve_page(const std::string& address, std::uint16_t port,
                                                 Scene& scene);

// What is shown, for Foxglove and whatever else speaks its WebSocket protocol (docs/foxglove.md).
// The feed outlives the server. on_client: called on the server's thread whenever a client has
// come.
//
// A request is let in only if its Host is `localhost` or an IP address, and if it comes from a
// program, from a page of this PC or from Foxglove's own: no other page of the internet can read
// along.
[[nodiscard]] std::unique_ptr<Server> serve_foxglove(const std::string& address, std::uint16_t port,
                                                     foxglove::LiveFeed& feed,
                                                     std::function<void()> on_client);

}  // namespace iog::tools::view
