#include "tools/formats/picture/pgm.hpp"

#include "tools/program/file.hpp"

namespace iog::tools {

void write_pgm(const std::string& path, std::size_t width, std::size_t height,
               std::span<const std::uint8_t> pixels) {
  const std::string head =
      "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  OutputFile file(path);
  file.write(std::as_bytes(std::span(head)));
  file.write(std::as_bytes(pixels));
  file.finish();
}

}  // namespace iog::tools
