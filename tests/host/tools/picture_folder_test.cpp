#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "checksum/crc32.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/picture/canvas.hpp"
#include "tools/formats/picture/frame_writer.hpp"
#include "tools/formats/picture/png_mark.hpp"
#include "tools/formats/picture/ros_map.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kHeaderChunkBytes = 12 + 13;

void put_words(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

std::string words_in(const std::string& path) {
  const auto bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

GridFrame evidence_frame(std::uint64_t number) {
  GridFrame frame;
  frame.evidence_number = number;
  frame.header.complete_sensors = 1;
  return frame;
}

std::string complaint_at(const std::string& folder) {
  try {
    const FrameWriter writer({.folder = folder, .every = 1, .scale = {}}, true);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

// PNG specification: after the signature, chunks of length, type, content, and CRC-32 of the two.
TEST(PngMark, IsAChunkOfText) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "picture.png";
  Canvas(3, 2, {}).write_png(path);
  const std::vector<std::byte> png = read_file(path);
  std::vector<std::string> types;
  for (std::span<const std::byte> rest = std::span(png).subspan(kSignatureBytes); !rest.empty();) {
    const std::size_t bytes = 4 + wire::load_be32(rest.first<4>());
    const auto words = rest.subspan(4, bytes);
    checksum::Crc32 crc;
    crc.update(words);
    EXPECT_EQ(crc.value(), wire::load_be32(rest.subspan(4 + bytes).first<4>()));
    types.emplace_back(reinterpret_cast<const char*>(words.data()), 4);
    if (types.back() == "tEXt") {
      using namespace std::string_literals;
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(words.data()), bytes),
                "tEXtSoftware\0iogrid"s);
    }
    rest = rest.subspan(8 + bytes);
  }
  EXPECT_EQ(types, (std::vector<std::string>{"IHDR", "tEXt", "sRGB", "IDAT", "IEND"}));
  EXPECT_TRUE(is_own_picture(path));
}

// Those of before the mark are iog's, too. The mark has 8 + 4 + 15 bytes.
TEST(PngMark, APictureOfAnOlderIogHasNone) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "picture.png";
  Canvas(3, 2, {}).write_png(path);
  std::string png = words_in(path);
  png.erase(kSignatureBytes + kHeaderChunkBytes, 27);
  put_words(path, png);
  EXPECT_TRUE(is_own_picture(path));
  png.erase(kSignatureBytes + kHeaderChunkBytes, 13);  // sRGB
  put_words(path, png);
  EXPECT_FALSE(is_own_picture(path));
  EXPECT_FALSE(is_own_picture(folder.path()));
  EXPECT_FALSE(is_own_picture(folder / "missing.png"));
}

TEST(PictureFolder, FilesOfOthersStay) {
  for (const char* const name :
       {"frame_000000.png", "classes_1234567.png", "map.pgm", "map.yaml", "map_000002.pgm"}) {
    const tests::TemporaryFolder folder;
    put_words(folder / name, "mine");
    EXPECT_EQ(complaint_at(folder.path()),
              folder / name + ": not written by iog, or edited since; give another --out");
    EXPECT_EQ(words_in(folder / name), "mine");
  }
  const tests::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "frame_000000.png");
  EXPECT_NE(complaint_at(folder.path()), "");
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_000000.png"));
}

// As map_saver of ROS 1 (1.17) and of ROS 2 (nav2, 1.1) write them.
TEST(PictureFolder, AMapOfMapSaverStays) {
  const std::array<std::string, 2> maps{
      "image: map.pgm\nresolution: 0.050000\norigin: [-10.000000, -10.000000, 0.000000]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n",
      "image: map.pgm\nmode: trinary\nresolution: 0.05\norigin: [-10, -10, 0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196"};
  for (const std::string& map : maps) {
    const tests::TemporaryFolder folder;
    put_words(folder / "map.pgm", "P5");
    put_words(folder / "map.yaml", map);
    EXPECT_TRUE(complaint_at(folder.path()).starts_with(folder / "map.yaml: not written by iog"));
    EXPECT_EQ(words_in(folder / "map.yaml"), map);
  }
}

TEST(PictureFolder, WhatAnEarlierRunLeftGoesWithTheFirstPicture) {
  const tests::TemporaryFolder folder;
  const PictureOptions options{.folder = folder.path(), .every = 1, .scale = {}};
  FrameWriter before(options);
  for (std::uint64_t number = 0; number < 3; ++number) {
    before.offer(evidence_frame(number));
  }
  before.write_last(evidence_frame(2));
  write_ros_map(folder.path(), "map_000002", {.cells = {1}, .grid = {.columns = 1, .rows = 1}});
  const auto is_there = [&](const char* name) { return std::filesystem::exists(folder / name); };
  { const FrameWriter failing(options, true); }
  EXPECT_TRUE(is_there("frame_000002.png") && is_there("map_000002.pgm"));
  FrameWriter after(options, true);
  after.offer(evidence_frame(0));
  EXPECT_TRUE(is_there("frame_000000.png") && is_there("map.yaml"));
  for (const char* const name :
       {"frame_000001.png", "frame_000002.png", "map_000002.pgm", "map_000002.yaml"}) {
    EXPECT_FALSE(is_there(name)) << name;
  }
}

}  // namespace
}  // namespace iog::tools
