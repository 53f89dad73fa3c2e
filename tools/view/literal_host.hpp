// In whose name this server may be asked for what.
#pragma once

#include <string_view>

namespace iog::tools::view {

// "localhost", "127.0.0.1:8080", "[::1]:8080": a host that no name service can have invented.
[[nodiscard]] bool is_literal_host(std::string_view host);

// Whether a stranger to our page may read along. origin: of the page that a browser asks for; empty
// if no browser asks. host: that the request names as ours, a literal one. Pages of this server, of
// this PC and of foxglove.dev, and programs, may; any other page that a browser has open may not.
[[nodiscard]] bool is_foxglove_or_here(std::string_view origin, std::string_view host);

}  // namespace iog::tools::view
