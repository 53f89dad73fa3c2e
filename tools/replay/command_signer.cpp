#include "tools/replay/command_signer.hpp"

#include <limits>

#include "tools/program/exit_status.hpp"

namespace iog::tools {

std::vector<std::byte> CommandSigner::as_sent(const protection::Channel& channel,
                                              std::span<const std::byte> message) {
  using authentication::kTrailerBytes;
  std::vector<std::byte> sent(message.begin(), message.end());
  if (!key_ ||
      (!authentication::is_signed(message) && (message.size() < protection::kProtectionBytes ||
                                               message.size() > protection::kMaxMessageBytes))) {
    return sent;
  }
  if (last_.counter == std::numeric_limits<std::uint32_t>::max()) {
    throw UsageError("no counter is left to sign with; start the target anew");
  }
  ++last_.counter;
  sent.resize(message.size() + (authentication::is_signed(message) ? 0 : kTrailerBytes));
  authentication::sign(*key_, channel.event.event_id, last_, sent);
  return sent;
}

}  // namespace iog::tools
