// The reader of MCAP files, on a file in memory.
#include <sstream>
#include <string>

#include "law.hpp"
#include "stream/crc32.hpp"
#include "tools/formats/mcap/reader.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::fuzz {

void check(std::span<const std::byte> input) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(input.data()), input.size()));
  try {
    tools::mcap::Reader reader(in);
    std::uint64_t messages = 0;
    while (const auto message = reader.next()) {
      law(reader.channels().contains(message->channel_id), "a message has a channel");
      // AddressSanitizer sees whether all of it is there.
      stream::Crc32 crc;
      crc.update(message->data);
      static_cast<void>(crc.value());
      ++messages;
    }
    law(messages == reader.counts().messages, "every message is counted once");
    law(reader.counts().broken_chunks + reader.counts().unreadable_chunks <= reader.counts().chunks,
        "a chunk has one fate");
    law(reader.next() == std::nullopt, "an end is an end");
  } catch (const tools::UsageError&) {
    return;  // not an MCAP file
  }
}

}  // namespace iog::fuzz
