#include "tools/formats/picture/png_mark.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace iog::tools {
namespace {

using namespace std::string_view_literals;

// PNG specification, 5.2, 11.2.2: the signature and the chunk IHDR, with its CRC.
constexpr std::string_view kBegin = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR"sv;
constexpr std::size_t kHeaderEnd = kBegin.size() + 13 + 4;

// 11.3.4.3: keyword, 0, text; the CRC is that of zlib.
constexpr std::string_view kMark = "\0\0\0\x0ftEXtSoftware\0iogrid\xea\xe1\xe7\xbe"sv;

// Without the mark: 8 bits of RGB, not interlaced; sRGB; then the pixels.
constexpr std::size_t kFormatAt = kBegin.size() + 8;
constexpr std::string_view kFormat = "\x08\x02\0\0\0"sv;
constexpr std::string_view kSrgb = "\0\0\0\x01sRGB\0\xae\xce\x1c\xe9"sv;
constexpr std::size_t kPixelsAt = kHeaderEnd + kSrgb.size() + 4;

}  // namespace

std::vector<std::byte> with_mark(std::span<const std::byte> png) {
  const auto header = png.first(kHeaderEnd);
  const auto mark = std::as_bytes(std::span(kMark));
  const auto others = png.subspan(kHeaderEnd);
  std::vector<std::byte> marked(header.begin(), header.end());
  marked.insert(marked.end(), mark.begin(), mark.end());
  marked.insert(marked.end(), others.begin(), others.end());
  return marked;
}

bool is_own_picture(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return false;
  }
  std::string begin(100, '\0');
  std::ifstream(path, std::ios::binary)
      .read(begin.data(), static_cast<std::streamsize>(begin.size()));
  const auto has = [&](std::size_t at, std::string_view bytes) {
    return std::string_view(begin).substr(at).starts_with(bytes);
  };
  const bool is_unmarked =
      has(kFormatAt, kFormat) && has(kHeaderEnd, kSrgb) && has(kPixelsAt, "IDAT");
  return has(0, kBegin) && (has(kHeaderEnd, kMark) || is_unmarked);
}

}  // namespace iog::tools
