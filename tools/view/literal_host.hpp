// Whom a page may be asked for in the name of.
#pragma once

#include <string_view>

namespace iog::tools::view {

// "localhost", "127.0.0.1:8080", "[::1]:8080": a host that no name service can have invented.
[[nodiscard]] bool is_literal_host(std::string_view host);

}  // namespace iog::tools::view
