// Poses and maps on their way to a target that wants them signed (docs/spec.md, section 9).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "authentication/secured_message.hpp"
#include "protection/protected_message.hpp"

namespace iog::tools {

class CommandSigner {
 public:
  // Signs nothing: messages go as they are.
  CommandSigner() = default;
  // after: the run of the target, and the highest counter of which it has heard in it.
  CommandSigner(const authentication::Key& key, authentication::Freshness after)
      : key_(authentication::CmacKey(key)), last_(after) {}

  // The message as it is sent. One that carries a signature already gets a new one; what is no
  // message stays as it is. UsageError when no counter is left.
  [[nodiscard]] std::vector<std::byte> as_sent(const protection::Channel& channel,
                                               std::span<const std::byte> message);

 private:
  std::optional<authentication::CmacKey> key_;
  authentication::Freshness last_;
};

}  // namespace iog::tools
