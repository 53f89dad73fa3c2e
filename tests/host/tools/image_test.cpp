// Firmware images as files: the car's block is found by its place, and the CRCs around it follow.
// The images are made up here, as their formats' documents have them.
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "car_block/car_block.hpp"
#include "fakes/bitwise_crc32.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/image/car_of_image.hpp"
#include "tools/image/firmware_image.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

using Image = std::vector<std::byte>;

void put(Image& image, std::size_t at, std::uint32_t value, bool big_endian) {
  for (std::size_t i = 0; i < 4; ++i) {
    image.at(at + i) = static_cast<std::byte>(value >> (big_endian ? 24 - 8 * i : 8 * i));
  }
}

std::uint32_t be32(const Image& image, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | std::to_integer<std::uint32_t>(image.at(at + i));
  }
  return value;
}

Image raw_image() {
  const CatalogueEntry& car = find_vehicle("reference_car");
  Image image(0x1000 + 0x10000 + 1000, std::byte{0xA5});
  car_block::write_block(*car.vehicle, *car.network,
                         std::span(image).subspan(0x1000).first<car_block::kBlockBytes>());
  return image;
}

// A segment of something else, then one that runs at 0x10100000.
Image elf_image() {
  constexpr std::size_t kContentAt = 0x200;
  Image image(kContentAt);
  put(image, 0, 0x7F454C46, true);
  image[4] = image[5] = std::byte{1};
  image[18] = std::byte{40};             // EM_ARM
  put(image, 28, 52, false);             // program headers
  put(image, 42, 2U << 16 | 32, false);  // of 32 bytes, 2 of them
  put(image, 52, 0x70000001, false);
  put(image, 84, 1, false);
  put(image, 84 + 4, kContentAt, false);
  put(image, 84 + 12, 0x10100000, false);
  const Image content = raw_image();
  put(image, 84 + 16, static_cast<std::uint32_t>(content.size()), false);
  image.insert(image.end(), content.begin(), content.end());
  return image;
}

// The same for 64 bits and EM_AARCH64: System V ABI, "ELF-64 object file format".
Image elf64_image() {
  constexpr std::size_t kContentAt = 0x200;
  Image image(kContentAt);
  put(image, 0, 0x7F454C46, true);
  image[4] = std::byte{2};
  image[5] = std::byte{1};
  image[18] = std::byte{183};
  put(image, 32, 64, false);             // program headers
  put(image, 54, 2U << 16 | 56, false);  // of 56 bytes, 2 of them
  put(image, 64, 0x6474E551, false);
  put(image, 120, 1, false);
  put(image, 120 + 8, kContentAt, false);
  put(image, 120 + 24, 0x10100000, false);
  const Image content = raw_image();
  put(image, 120 + 32, static_cast<std::uint32_t>(content.size()), false);
  image.insert(image.end(), content.begin(), content.end());
  return image;
}

// U-Boot, include/image.h.
Image legacy_image() {
  const Image content = raw_image();
  Image image(64);
  put(image, 0, 0x27051956, true);
  put(image, 12, static_cast<std::uint32_t>(content.size()), true);
  put(image, 16, 0x10100000, true);
  put(image, 24, tests::BitwiseCrc32().add(content).value(), true);
  put(image, 28, 17U << 24 | 2U << 16 | 1U << 8, true);
  put(image, 4, tests::BitwiseCrc32().add(image).value(), true);
  image.insert(image.end(), content.begin(), content.end());
  return image;
}

// A boot record, something else, the image from a sector on, and nothing.
Image card() {
  Image image(std::size_t{4} * 512);
  image[510] = std::byte{0x55};
  image[511] = std::byte{0xAA};
  const Image content = legacy_image();
  image.insert(image.end(), content.begin(), content.end());
  image.resize((image.size() / 512 + 3) * 512);
  return image;
}

class ImageFile : public testing::Test {
 protected:
  std::string write(const Image& image) const {
    OutputFile file(path());
    file.write(image);
    file.finish();
    return path();
  }
  [[nodiscard]] std::string path() const { return folder_ / "image"; }

  // The image with another car, from the file.
  [[nodiscard]] Image with_other_car(const Image& before) const {
    FirmwareImage image(write(before));
    CatalogueEntry other = find_vehicle("reference_car");
    vehicle::Vehicle renamed = *other.vehicle;
    renamed.name = "another_car";
    other.vehicle = &renamed;
    put_car(other, image);
    image.write(path());
    return read_file(path());
  }

  tests::TemporaryFolder folder_;
};

// All but the block is as it was, except for `changing` bytes.
void expect_only_block_changed(const Image& before, const Image& after, std::size_t block_at,
                               std::size_t changing) {
  ASSERT_EQ(before.size(), after.size());
  std::size_t outside = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool is_inside = block_at <= i && i < block_at + car_block::kBlockBytes;
    (is_inside ? inside : outside) += before[i] != after[i] ? 1U : 0U;
  }
  EXPECT_GT(inside, 0U);
  EXPECT_LE(outside, changing);
}

TEST_F(ImageFile, OfEachKindIsFoundAndChanged) {
  struct Case {
    Image image;
    std::string_view kind;
    std::size_t block_at;
    std::size_t header_at;  // of U-Boot's; 0 with block_at 0x1000 and 0x1200: there is none
  };
  const std::array<Case, 5> cases{{{raw_image(), "raw image", 0x1000, 0},
                                   {elf_image(), "ELF", 0x1200, 0},
                                   {elf64_image(), "ELF", 0x1200, 0},
                                   {legacy_image(), "U-Boot image", 0x1040, 0},
                                   {card(), "card with a U-Boot image", 0x1840, 0x800}}};
  for (const Case& each : cases) {
    const Image after = with_other_car(each.image);
    const FirmwareImage image(path());
    EXPECT_EQ(image.kind(), each.kind);
    EXPECT_EQ(image.block_offset(), each.block_at);
    EXPECT_NE(words_of_image(image).find("another_car"), std::string::npos);
    const bool has_crcs = each.kind.find("U-Boot") != std::string_view::npos;
    expect_only_block_changed(each.image, after, each.block_at, has_crcs ? 8 : 0);
    if (has_crcs) {
      Image header(after.begin() + static_cast<std::ptrdiff_t>(each.header_at),
                   after.begin() + static_cast<std::ptrdiff_t>(each.header_at) + 64);
      const auto data = std::span(after).subspan(each.header_at + 64, be32(header, 12));
      EXPECT_EQ(be32(header, 24), tests::BitwiseCrc32().add(data).value());
      const std::uint32_t own = be32(header, 4);
      put(header, 4, 0, true);
      EXPECT_EQ(own, tests::BitwiseCrc32().add(header).value());
    }
  }
}

TEST_F(ImageFile, OfAnotherBoardIsRefused) {
  const FirmwareImage imx6(write(elf_image()));
  EXPECT_EQ(imx6.board(), "imx6");
  EXPECT_THROW(imx6.demand_board("zcu102"), UsageError);
  const FirmwareImage zcu102(write(elf64_image()));
  EXPECT_EQ(zcu102.board(), "zcu102");
  EXPECT_NO_THROW(zcu102.demand_board("zcu102"));
  EXPECT_THROW(zcu102.demand_board("imx6"), UsageError);
  EXPECT_EQ(FirmwareImage(write(card())).board(), "imx6");
  EXPECT_NO_THROW(FirmwareImage(write(raw_image())).demand_board("zcu102")) << "it does not say";
  EXPECT_THROW(zcu102.demand_board("zcu104"), UsageError);
}

TEST_F(ImageFile, WhatIsNoneIsRefused) {
  EXPECT_THROW(FirmwareImage{folder_ / "nowhere"}, UsageError);
  EXPECT_THROW(FirmwareImage{write({})}, UsageError);
  EXPECT_THROW(FirmwareImage{write(Image(100'000))}, UsageError);
  Image cut = raw_image();
  cut.resize(0x1000 + 0xFFFF);
  EXPECT_THROW(FirmwareImage{write(cut)}, UsageError);
  for (std::size_t at : {std::size_t{30}, std::size_t{64 + 0x3000}}) {
    Image damaged = legacy_image();
    damaged[at] ^= std::byte{1};
    EXPECT_THROW(FirmwareImage{write(damaged)}, UsageError) << at;
  }
  Image twice = card();
  const Image once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_THROW(FirmwareImage{write(twice)}, UsageError);
  Image wild = elf_image();
  put(wild, 28, 0xFFFFFFF0, false);
  EXPECT_THROW(FirmwareImage{write(wild)}, UsageError);
  wild = elf64_image();
  put(wild, 36, 0xFFFFFFFF, false);
  EXPECT_THROW(FirmwareImage{write(wild)}, UsageError);
  wild = elf64_image();
  put(wild, 120 + 12, 0xFFFFFFFF, false);  // a segment from outside the file
  EXPECT_THROW(FirmwareImage{write(wild)}, UsageError);
}

// The car's block is in the first segment; a loader needs the second and the sections, too.
TEST_F(ImageFile, AnElfFileThatIsCutOffIsRefused) {
  const auto told = [this](const Image& image) {
    try {
      static_cast<void>(FirmwareImage(write(image)));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const bool is_64 : {false, true}) {
    Image image = is_64 ? elf64_image() : elf_image();
    const std::size_t other_at = is_64 ? 64 : 52;  // its program header
    const auto end = static_cast<std::uint32_t>(image.size());
    put(image, other_at, 1, false);
    put(image, other_at + (is_64 ? 8 : 4), end, false);
    put(image, other_at + (is_64 ? 32 : 16), 500, false);
    put(image, is_64 ? 40 : 32, end + 500, false);                    // section headers
    put(image, is_64 ? 58 : 46, (is_64 ? 64 : 40) | 2 << 16, false);  // their size, 2 of them
    const std::size_t whole = image.size() + 500 + 2 * (is_64 ? 64 : 40);
    image.resize(whole);
    EXPECT_EQ(told(image), "");
    for (const std::size_t bytes : {whole - 1, std::size_t{end} + 499, std::size_t{end}}) {
      image.resize(bytes);
      EXPECT_EQ(told(image), path() + ": the ELF file is cut off: it has " + std::to_string(bytes) +
                                 " of the " + std::to_string(whole) +
                                 " bytes that its headers state; copy or build it anew");
    }
    put(image, is_64 ? 40 : 32, 0, false);  // stripped of them
    put(image, is_64 ? 58 : 46, 0, false);
    EXPECT_NE(told(image), "");
    image.resize(end + 500);
    EXPECT_EQ(told(image), "");
  }
}

TEST_F(ImageFile, ACarOfOtherGridsIsRefused) {
  FirmwareImage image(write(raw_image()));
  EXPECT_THROW(put_car(find_vehicle("two_lux_parking"), image), UsageError);
}

TEST_F(ImageFile, ADamagedBlockIsToldAndMended) {
  Image damaged = raw_image();
  damaged[0x1000 + 300] ^= std::byte{1};
  FirmwareImage image(write(damaged));
  EXPECT_THROW(demand_accepted(image), CheckFailed);
  put_car(find_vehicle("reference_car"), image);
  EXPECT_NO_THROW(demand_accepted(image));
}

std::string refusal_of(const FirmwareImage& image) {
  try {
    demand_accepted(image);
  } catch (const CheckFailed& refusal) {
    return refusal.what();
  }
  return {};
}

// As images-both has it (docs/vehicles.md): nothing is wrong with it, and nothing in it.
TEST_F(ImageFile, AFreshOneIsToldFromOneThatTheFirmwareRefuses) {
  Image fresh = raw_image();
  const auto block = std::span(fresh).subspan(0x1000).first<car_block::kBlockBytes>();
  const CatalogueEntry& car = find_vehicle("reference_car");
  car_block::write_block_without_car(vehicle::Grids::kBoth, *car.network, block);
  const std::string told = refusal_of(FirmwareImage(write(fresh)));
  EXPECT_TRUE(told.starts_with("there is no car in the image yet; `iog image ")) << told;
  EXPECT_TRUE(told.ends_with("grids = \"both\"")) << told;
  fresh[0x1000 + 128] = std::byte{'X'};  // where its magic number would stand
  EXPECT_EQ(refusal_of(FirmwareImage(write(fresh))),
            "the firmware refuses the car: description: it is not there");
}

// docs/spec.md 8.6. The check value is of OpenSSL 3.0: openssl mac over 16 zeros.
TEST_F(ImageFile, AKeyIsPutThereWithItsCar) {
  FirmwareImage image(write(raw_image()));
  EXPECT_EQ(words_of_image(image).find("commands"), std::string::npos);
  CatalogueEntry car = find_vehicle("reference_car");
  const std::string key_file = folder_ / "car.key";
  OutputFile key(key_file);
  key.write("2b7e151628aed2a6abf7158809cf4f3c\n");
  key.finish();
  car.key_file = key_file;
  put_car(car, image);
  EXPECT_NE(words_of_image(image).find("signed, check value of the key 7ad386c376"),
            std::string::npos)
      << words_of_image(image);
  put_car(find_vehicle("reference_car"), image);
  EXPECT_FALSE(car_block::read_key(image.block())) << "a car without a key takes it away";
}

}  // namespace
}  // namespace iog::tools
