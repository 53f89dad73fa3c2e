// The format: draft-ietf-opsawg-pcap, "PCAP Capture File Format".
#include "capture.hpp"

#include "wire/byte_reader.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kFileHeaderBytes = 24;
constexpr std::size_t kRecordHeaderBytes = 16;
constexpr std::uint32_t kMagicMicroseconds = 0xA1B2C3D4;
constexpr std::uint32_t kMagicNanoseconds = 0xA1B23C4D;
constexpr std::uint32_t kLinkTypeMask = 0x0FFF'FFFF;
constexpr std::uint32_t kLinkTypeEthernet = 1;

}  // namespace

Capture::~Capture() { close(); }

void Capture::close() {
  if (file_ != nullptr) {
    std::fclose(file_);
    file_ = nullptr;
  }
}

bool Capture::open(const char* path) {
  close();
  file_ = std::fopen(path, "rb");
  std::array<std::byte, kFileHeaderBytes> header{};
  if (file_ == nullptr || !read(header)) {
    return false;
  }
  wire::ByteReader reader(header);
  const std::uint32_t magic = reader.u32_le();
  reader.skip(16);  // version, two fields that are always zero, the longest frame
  const std::uint32_t link_type = reader.u32_le() & kLinkTypeMask;
  fractions_per_us_ = magic == kMagicNanoseconds ? 1000 : 1;
  return (magic == kMagicMicroseconds || magic == kMagicNanoseconds) &&
         link_type == kLinkTypeEthernet;
}

std::optional<CapturedFrame> Capture::next() {
  std::array<std::byte, kRecordHeaderBytes> header{};
  while (read(header)) {
    wire::ByteReader reader(header);
    const std::uint64_t seconds = reader.u32_le();
    const std::uint32_t fraction = reader.u32_le();
    const std::uint32_t captured_bytes = reader.u32_le();
    const std::uint32_t frame_bytes = reader.u32_le();
    if (captured_bytes > frame_.size() || !read(std::span(frame_).first(captured_bytes))) {
      break;
    }
    if (captured_bytes >= frame_bytes) {
      return CapturedFrame{seconds * 1'000'000 + fraction / fractions_per_us_,
                           std::span(frame_).first(captured_bytes)};
    }
  }
  return std::nullopt;
}

bool Capture::read(std::span<std::byte> target) {
  return std::fread(target.data(), 1, target.size(), file_) == target.size();
}

}  // namespace iog::lab
