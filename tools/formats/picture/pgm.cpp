#include "tools/formats/picture/pgm.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

std::string head_of(std::string_view remark) {
  return "P5\n" + (remark.empty() ? "" : "# " + std::string(remark) + "\n");
}

}  // namespace

void write_pgm(const std::string& path, std::size_t width, std::size_t height,
               std::span<const std::uint8_t> pixels, std::string_view remark) {
  const std::string head =
      head_of(remark) + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  OutputFile file(path);
  file.write(std::as_bytes(std::span(head)));
  file.write(std::as_bytes(pixels));
  file.finish();
}

bool has_remark(const std::string& path, std::string_view remark) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return false;
  }
  const std::string wanted = head_of(remark);
  std::string head(wanted.size(), ' ');
  std::ifstream(path, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == wanted;
}

}  // namespace iog::tools
