// The bytes of a file as they were before gzip (RFC 1952) or zstd (RFC 8878) has packed it, if one
// has. They come in their order and in bounded memory, also out of a pipe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace iog::tools {

class UnpackedFile {
 public:
  // UsageError if the file cannot be read. "-" is standard input.
  explicit UnpackedFile(const std::string& path);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  // Some of the next bytes; none where nothing more comes.
  [[nodiscard]] std::size_t read(std::span<std::byte> to);

  // How many bytes have come.
  [[nodiscard]] std::uint64_t place() const { return unpacked_; }

  // Whether the bytes can be read from any place: what nothing has packed, and is no pipe.
  [[nodiscard]] bool can_go() const { return !unpacker_ && file_bytes_ > 0; }

  // The next byte is that of a place in the file; false, and nothing is changed, where that cannot
  // be.
  [[nodiscard]] bool go_to(std::uint64_t place);

  // "breaks off: …", why there is nothing more to read; empty if that is the file's end.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

  // "gzip" or "zstd"; empty if nothing has packed the file.
  [[nodiscard]] std::string packer() const;

  // The first bytes, 1208 at most, as far as they have been read.
  [[nodiscard]] std::span<const std::byte> begin() const { return begin_; }

  // How much of the file has been read, 0 to 1; nothing where nobody knows its size.
  [[nodiscard]] std::optional<double> part_read() const;

  // A capture of a target that sees nothing at all packs to a sixtieth. What unpacks to more than
  // that many times its size is not read beyond the first bytes.
  static constexpr std::uint64_t kMaxRatio = 500;
  static constexpr std::uint64_t kAlwaysUnpacked = 64U << 20;

  class Unpacker;

 private:
  // Whether there is more of the packed file in the buffer. Reads on if that is used up.
  [[nodiscard]] bool has_input();
  [[nodiscard]] std::size_t unpack(std::span<std::byte> to);

  int descriptor_ = -1;
  std::uint64_t file_bytes_ = 0;  // 0: not known
  std::uint64_t packed_ = 0;      // bytes read so far, and what they have become
  std::uint64_t unpacked_ = 0;
  std::vector<std::byte> buffer_;
  std::span<const std::byte> input_;  // what is left in the buffer
  std::vector<std::byte> begin_;
  std::unique_ptr<Unpacker> unpacker_;
  bool has_ended_ = false;
  std::string trouble_;
};

}  // namespace iog::tools
