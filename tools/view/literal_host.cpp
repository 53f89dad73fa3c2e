#include "tools/view/literal_host.hpp"

#include <arpa/inet.h>
#include <string>

namespace iog::tools::view {
namespace {

// Without the port.
std::string_view name_of(std::string_view host) {
  const std::size_t bracket = host.rfind(']');
  const std::size_t colon = host.rfind(':');
  const bool has_port =
      colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
  return has_port ? host.substr(0, colon) : host;
}

}  // namespace

bool is_literal_host(std::string_view host) {
  std::string name(name_of(host));
  if (name.size() >= 2 && name.front() == '[' && name.back() == ']') {
    name = name.substr(1, name.size() - 2);
  }
  in6_addr address{};  // either kind fits
  return name == "localhost" || inet_pton(AF_INET, name.c_str(), &address) == 1 ||
         inet_pton(AF_INET6, name.c_str(), &address) == 1;
}

// Programs with a window of their own have origins such as app:// or file://, which no page of the
// internet can have. "null" can be any page's.
bool is_foxglove_or_here(std::string_view origin, std::string_view host) {
  constexpr std::string_view kMark = "://";
  const std::size_t mark = origin.find(kMark);
  if (mark == std::string_view::npos) {
    return origin.empty();
  }
  const std::string_view scheme = origin.substr(0, mark);
  const std::string_view name = name_of(origin.substr(mark + kMark.size()));
  const bool is_here =
      name == name_of(host) || name == "localhost" || name == "127.0.0.1" || name == "[::1]";
  return is_here || (scheme == "https" && name.ends_with(".foxglove.dev")) ||
         (scheme != "http" && scheme != "https");
}

}  // namespace iog::tools::view
