#include "tools/image/firmware_image.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "checksum/crc32.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

using Bytes = std::span<const std::byte>;

// Where images of each board run (linker/<board>.ld), and what their ELF header says (System V ABI,
// e_ident[EI_CLASS] and e_machine).
struct Board {
  std::string_view name;
  std::uint32_t load_address = 0;
  std::byte elf_class{};
  std::uint16_t machine = 0;

  [[nodiscard]] std::uint64_t block_address() const {
    return std::uint64_t{load_address} + car_block::kOffsetInImage;
  }
};
constexpr auto kBoards = std::to_array<Board>({
    {"imx6", 0x10100000, std::byte{1}, 40},
    {"zcu102", 0x10100000, std::byte{2}, 183},
});
constexpr const Board& kImx6 = kBoards.front();  // the one whose loader takes legacy images

// U-Boot, include/image.h: the header of a legacy image, big endian.
constexpr std::size_t kLegacyHeaderBytes = 64;
constexpr std::uint32_t kLegacyMagic = 0x27051956;
constexpr std::size_t kHeaderCrcAt = 4;
constexpr std::size_t kSizeAt = 12;
constexpr std::size_t kLoadAt = 16;
constexpr std::size_t kDataCrcAt = 24;
constexpr std::size_t kTypeAt = 30;
constexpr auto kStandalone = std::byte{1};

constexpr std::size_t kSector = 512;

std::uint32_t be32(Bytes bytes, std::size_t at) {
  return wire::load_be32(bytes.subspan(at).first<4>());
}
std::uint32_t le32(Bytes bytes, std::size_t at) {
  return wire::load_le32(bytes.subspan(at).first<4>());
}
std::uint64_t le64(Bytes bytes, std::size_t at) {
  return wire::load_le64(bytes.subspan(at).first<8>());
}
std::uint16_t le16(Bytes bytes, std::size_t at) {
  return wire::load_le16(bytes.subspan(at).first<2>());
}
void put_be32(std::span<std::byte> bytes, std::size_t at, std::uint32_t value) {
  wire::store_be32(bytes.subspan(at).first<4>(), value);
}

std::uint32_t crc_of(Bytes bytes) {
  checksum::Crc32 crc;
  crc.update(bytes);
  return crc.value();
}

// The header's own CRC is taken with 0 in its place.
std::uint32_t crc_of_header(Bytes header) {
  constexpr std::array<std::byte, 4> kZeros{};
  checksum::Crc32 crc;
  crc.update(header.first(kHeaderCrcAt));
  crc.update(kZeros);
  crc.update(header.first(kLegacyHeaderBytes).subspan(kHeaderCrcAt + 4));
  return crc.value();
}

// Of a firmware: a script has the same header, and another type.
bool is_legacy_header(Bytes bytes) {
  return bytes.size() >= kLegacyHeaderBytes && be32(bytes, 0) == kLegacyMagic &&
         bytes[kTypeAt] == kStandalone && be32(bytes, kLoadAt) == kImx6.load_address &&
         be32(bytes, kHeaderCrcAt) == crc_of_header(bytes);
}

// Little endian, and of the first board of its class: another machine has no block there.
const Board* board_of_elf(Bytes bytes) {
  if (bytes.size() < 64 || be32(bytes, 0) != 0x7F454C46 || bytes[5] != std::byte{1}) {
    return nullptr;
  }
  const auto* const found = std::ranges::find_if(kBoards, [bytes](const Board& board) {
    return board.elf_class == bytes[4] && board.machine == le16(bytes, 18);
  });
  return found == kBoards.end() ? nullptr : found;
}

// One program header, of either class.
struct Segment {
  std::uint32_t type = 0;
  std::uint64_t at = 0;  // in the file
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
};
Segment segment_32(Bytes header) {
  return {le32(header, 0), le32(header, 4), le32(header, 12), le32(header, 16)};
}
Segment segment_64(Bytes header) {
  return {le32(header, 0), le64(header, 8), le64(header, 24), le64(header, 32)};
}

// Empty if the table of program headers is not in the file.
std::vector<Segment> segments_of(Bytes bytes, const Board& board) {
  const bool is_64 = board.elf_class == std::byte{2};
  const std::uint64_t headers_at = is_64 ? le64(bytes, 32) : le32(bytes, 28);
  const std::size_t header_bytes = le16(bytes, is_64 ? 54 : 42);
  const std::size_t count = le16(bytes, is_64 ? 56 : 44);
  constexpr std::uint32_t kLoad = 1;
  std::vector<Segment> segments;
  if (header_bytes < (is_64 ? 56U : 32U) || headers_at > bytes.size() ||
      count * header_bytes > bytes.size() - headers_at) {
    return segments;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Bytes header = bytes.subspan(headers_at + i * header_bytes, header_bytes);
    const Segment segment = is_64 ? segment_64(header) : segment_32(header);
    if (segment.type == kLoad) {
      segments.push_back(segment);
    }
  }
  return segments;
}

// By its segments and the table of its sections, which U-Boot's `bootelf` reads.
std::uint64_t whole_bytes_of_elf(Bytes bytes, const Board& board) {
  const bool is_64 = board.elf_class == std::byte{2};
  const auto end_of = [](std::uint64_t at, std::uint64_t size) {
    return at + std::min(size, std::numeric_limits<std::uint64_t>::max() - at);
  };
  const std::uint64_t sections_at = is_64 ? le64(bytes, 40) : le32(bytes, 32);
  const std::uint64_t section_bytes = le16(bytes, is_64 ? 58 : 46);
  std::uint64_t whole = end_of(sections_at, section_bytes * le16(bytes, is_64 ? 60 : 48));
  for (const Segment& segment : segments_of(bytes, board)) {
    whole = std::max(whole, end_of(segment.at, segment.bytes));
  }
  return whole;
}

// Which byte of the file stands at the block's address.
std::optional<std::size_t> place_in_elf(Bytes bytes, const Board& board) {
  for (const Segment& segment : segments_of(bytes, board)) {
    const std::uint64_t before = board.block_address() - segment.address;
    if (segment.address <= board.block_address() && before <= segment.bytes &&
        car_block::kBlockBytes <= segment.bytes - before && segment.at < bytes.size() &&
        before < bytes.size() - segment.at) {
      return segment.at + before;
    }
  }
  return std::nullopt;
}

bool is_card(Bytes bytes) {
  return bytes.size() % kSector == 0 && bytes.size() > kSector && bytes[510] == std::byte{0x55} &&
         bytes[511] == std::byte{0xAA};
}

// Of all files of the card that begin like one.
std::vector<std::size_t> legacy_images_on(Bytes card) {
  std::vector<std::size_t> found;
  for (std::size_t at = kSector; at < card.size(); at += kSector) {
    if (is_legacy_header(card.subspan(at))) {
      found.push_back(at);
    }
  }
  return found;
}

}  // namespace

FirmwareImage::FirmwareImage(const std::string& path) : path_(path), bytes_(read_file(path)) {
  if (const Board* const board = board_of_elf(bytes_)) {
    kind_ = "ELF";
    board_ = board->name;
    const std::uint64_t whole = whole_bytes_of_elf(bytes_, *board);
    if (whole > bytes_.size()) {
      throw error("the ELF file is cut off: it has " + std::to_string(bytes_.size()) + " of the " +
                  std::to_string(whole) + " bytes that its headers state; copy or build it anew");
    }
    block_at_ = place_in_elf(bytes_, *board).value_or(bytes_.size());
  } else if (is_legacy_header(bytes_)) {
    kind_ = "U-Boot image";
    board_ = kImx6.name;
    find_in_legacy_image(0);
  } else if (is_card(bytes_)) {
    kind_ = "card with a U-Boot image";
    board_ = kImx6.name;
    const std::vector<std::size_t> found = legacy_images_on(bytes_);
    if (found.size() != 1) {
      throw error("a card with " + std::to_string(found.size()) +
                  " U-Boot images of the firmware; there must be one");
    }
    find_in_legacy_image(found.front());
  } else {
    kind_ = "raw image";
    block_at_ = car_block::kOffsetInImage;
  }
  if (block_at_ + car_block::kBlockBytes > bytes_.size() ||
      be32(bytes_, block_at_) != car_block::kFirmwareRecord.magic) {
    throw error("no firmware image with a car's block; this looks like a " + std::string(kind_));
  }
}

UsageError FirmwareImage::error(const std::string& text) const {
  return UsageError(path_ + ": " + text);
}

// Its CRC says, too, that it lies on the card in one piece.
void FirmwareImage::find_in_legacy_image(std::size_t header_at) {
  const Bytes header = Bytes(bytes_).subspan(header_at);
  const std::size_t size = be32(header, kSizeAt);
  if (size < car_block::kOffsetInImage + car_block::kBlockBytes ||
      size > header.size() - kLegacyHeaderBytes ||
      crc_of(header.subspan(kLegacyHeaderBytes, size)) != be32(header, kDataCrcAt)) {
    throw error("the U-Boot image is damaged, or not in one piece; make it anew");
  }
  legacy_header_at_ = header_at;
  legacy_bytes_ = size;
  block_at_ = header_at + kLegacyHeaderBytes + car_block::kOffsetInImage;
}

void FirmwareImage::demand_board(std::string_view name) const {
  if (!std::ranges::any_of(kBoards, [name](const Board& board) { return board.name == name; })) {
    throw UsageError("there is no board " + std::string(name) + "; there are imx6 and zcu102");
  }
  if (!board_.empty() && board_ != name) {
    throw error("an image for the board " + std::string(board_) + ", not for " + std::string(name));
  }
}

car_block::Block FirmwareImage::block() const {
  return Bytes(bytes_).subspan(block_at_).first<car_block::kBlockBytes>();
}

void FirmwareImage::set_block(car_block::Block block) {
  const std::span<std::byte> bytes(bytes_);
  std::ranges::copy(block, bytes.subspan(block_at_).begin());
  if (legacy_bytes_ == 0) {
    return;
  }
  const std::span<std::byte> header = bytes.subspan(legacy_header_at_);
  put_be32(header, kDataCrcAt, crc_of(header.subspan(kLegacyHeaderBytes, legacy_bytes_)));
  put_be32(header, kHeaderCrcAt, crc_of_header(header));
}

void FirmwareImage::write(const std::string& path) const {
  OutputFile file(path);
  file.write(bytes_);
  file.finish();
}

}  // namespace iog::tools
