// Serves the page and the messages of a scene to browsers, on a thread of its own.
//
// A request is answered only if its Host is `localhost` or an IP address, and a WebSocket only if
// it is opened by a page of this very server: so no page of the internet can read along, neither
// directly nor by a name that it has pointed here (DNS rebinding).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "tools/view/scene.hpp"

namespace iog::tools::view {

class WebServer {
 public:
  // Port 0: any free one. UsageError if that address and port cannot be had. The scene outlives
  // the server.
  WebServer(const std::string& address, std::uint16_t port, Scene& scene);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace iog::tools::view
