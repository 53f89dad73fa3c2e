// Session ids and the reboot flag (AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol, "Session Handling",
// "Reboot Detection"): ids count from 1, the flag is set until they have wrapped.
#pragma once

#include <cstdint>

#include "discovery/message.hpp"
#include "protection/some_ip.hpp"

namespace iog::discovery {

struct Session {
  std::uint16_t id = 0;  // 0: none has been heard
  bool reboot = false;
};

// Of what we send to one kind of receiver.
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

// What a partner sends, by one way.
class SessionWatch {
 public:
  // True if the partner has started anew since its last message by this way.
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
