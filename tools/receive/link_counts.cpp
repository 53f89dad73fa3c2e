#include "tools/receive/link_counts.hpp"

#include <algorithm>

#include "tools/program/table.hpp"

namespace iog::tools {

LinkCounts link_counts(const FrameAssembler& assembler) {
  const MessageCounts& counts = assembler.counts();
  return {{"messages", counts.messages},
          {"message_bytes", counts.bytes},
          {"messages_lost", assembler.messages_lost()},
          {"frames_lost", assembler.frames_lost()},
          {"messages_late", counts.late},
          {"messages_repeated", counts.repeated},
          {"messages_too_late", counts.too_late},
          {"messages_of_another_run", counts.other_run},
          {"messages_corrupt", counts.corrupt},
          {"messages_malformed", counts.malformed},
          {"messages_not_ours", counts.not_ours},
          {"messages_other_version", counts.other_version},
          {"messages_not_understood", counts.not_understood},
          {"signatures", counts.signatures},
          {"signatures_forged", counts.forged_signatures},
          {"messages_not_signed", counts.not_signed},
          {"tiles_malformed", counts.tiles_malformed},
          {"tiles_not_understood", counts.tiles_not_understood},
          {"tiles_without_reference", counts.without_reference},
          {"target_restarts", counts.restarts}};
}

std::string rows_of(const LinkCounts& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    const bool is_always_shown =
        name == "messages" || name == "message_bytes" || name == "messages_lost";
    if (count > 0 || is_always_shown) {
      std::string words = name;
      std::ranges::replace(words, '_', ' ');
      text += row(words, std::to_string(count));
    }
  }
  return text;
}

}  // namespace iog::tools
