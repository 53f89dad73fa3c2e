// Session IDs and the reboot flag (AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol, "Session Handling",
// "Reboot Detection"). Session IDs start at 1. The reboot flag is set until the session IDs have
// wrapped around.
#pragma once

#include <cstdint>

#include "discovery/message.hpp"
#include "protection/some_ip.hpp"

namespace iog::discovery {

struct Session {
  std::uint16_t id = 0;  // 0 if none was received
  bool reboot = false;
};

// Assigns session IDs to either all multicast messages or all unicast messages.
class SessionCounter {
 public:
  [[nodiscard]] constexpr Session take() {
    const Session now = next_;
    next_.reboot = next_.reboot && now.id != 0xFFFF;
    next_.id = protection::session_after(now.id);
    return now;
  }

 private:
  Session next_{.id = 1, .reboot = true};
};

// Tracks the session IDs of a communication partner on one path, either unicast or multicast.
class SessionWatch {
 public:
  // Returns true if the partner has rebooted since its last message on this path.
  [[nodiscard]] constexpr bool is_rebooted(Session now) {
    const Session before = last_;
    last_ = now;
    return before.id != 0 && now.reboot && (!before.reboot || now.id <= before.id);
  }

 private:
  Session last_{};
};

[[nodiscard]] constexpr Session session_of(const Message& message) {
  return {.id = message.session_id, .reboot = (message.flags & kFlagReboot) != 0};
}

}  // namespace iog::discovery
