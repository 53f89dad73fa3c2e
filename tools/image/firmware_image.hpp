// A firmware image as a file, and the car's block in it (docs/spec.md, section 8): as the linker,
// or what makes images for the board's loaders (docs/board.md), has left it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "car_block/layout.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {

class FirmwareImage {
 public:
  // UsageError if the file cannot be read, or is no image with a block.
  explicit FirmwareImage(const std::string& path);

  // "ELF", "raw image", "U-Boot image", "card with a U-Boot image"
  [[nodiscard]] std::string_view kind() const { return kind_; }
  // "imx6", "zcu102"; empty for a raw image, which does not say it.
  [[nodiscard]] std::string_view board() const { return board_; }
  // UsageError if there is no such board, or if the image is known to be for another one.
  void demand_board(std::string_view name) const;
  [[nodiscard]] std::size_t block_offset() const { return block_at_; }

  [[nodiscard]] car_block::Block block() const;
  // Another one in its place; the CRCs around it follow.
  void set_block(car_block::Block block);

  // Whole, or not at all: a file of that name is replaced in the end. UsageError if it cannot be.
  void write(const std::string& path) const;

 private:
  [[nodiscard]] UsageError error(const std::string& text) const;
  void find_in_legacy_image(std::size_t header_at);

  std::string path_;
  std::vector<std::byte> bytes_;
  std::string_view kind_;
  std::string_view board_;
  std::size_t block_at_ = 0;
  std::size_t legacy_header_at_ = 0;
  std::size_t legacy_bytes_ = 0;  // behind the header; 0: there is none
};

}  // namespace iog::tools
