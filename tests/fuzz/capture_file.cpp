// The reader of capture files, on a file in memory.
#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include "law.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::fuzz {
namespace {

constexpr std::size_t kMaxUdpBytes = 65'507;

class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::byte> bytes) : descriptor_{memfd_create("capture", 0)} {
    law(descriptor_ >= 0 &&
            write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
        "there is memory for a file");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

void check(std::span<const std::byte> input) {
  const MemoryFile file(input);
  try {
    tools::PcapReader reader(file.path());
    std::uint64_t datagrams = 0;
    while (const auto datagram = reader.next()) {
      law(datagram->payload.size() <= kMaxUdpBytes, "a datagram is not longer than UDP allows");
      ++datagrams;
    }
    law(datagrams == reader.counts().datagrams, "every datagram is counted once");
    static_cast<void>(tools::describe_skipped(reader.counts()));
  } catch (const tools::UsageError&) {
    return;  // not a capture
  }
}

}  // namespace iog::fuzz
