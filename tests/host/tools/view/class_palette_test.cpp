// The page names and colours classes as pictures of them do.
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "stream/class_window.hpp"
#include "tools/formats/picture/class_picture.hpp"
#include "tools/view/page_files.hpp"

namespace iog::tools::view {
namespace {

struct Row {
  std::string name;
  std::array<int, 3> colour{};
};

// Lines such as { name: "moving", colour: [255, 40, 160] }, up to the bracket that ends the table.
std::vector<Row> table_of_page() {
  const std::string_view script = page_file("/palette.js")->content;
  const std::string_view from_table = script.substr(script.find("const CLASSES = ["));
  std::string_view table = from_table.substr(0, from_table.find("\n];"));
  std::vector<Row> rows;
  for (std::size_t at = table.find("{ name: \""); at != std::string_view::npos;
       at = table.find("{ name: \"")) {
    table.remove_prefix(at + 9);
    Row row{.name = std::string(table.substr(0, table.find('"')))};
    const std::string numbers(table.substr(table.find('['), 20));
    EXPECT_EQ(std::sscanf(numbers.c_str(), "[%d, %d, %d]", &row.colour[0], &row.colour[1],
                          &row.colour[2]),
              3);
    rows.push_back(row);
  }
  return rows;
}

TEST(ClassPalette, ThePageHasTheNamesAndColoursOfPictures) {
  const std::vector<Row> rows = table_of_page();
  ASSERT_EQ(rows.size(), stream::kClassCount);
  for (std::size_t what = 0; what < rows.size(); ++what) {
    EXPECT_EQ(rows[what].name, name_of_class(static_cast<decision::Class>(what)));
    const int surest = what == 0 ? 0 : static_cast<int>(what) * 8 + 7;
    const Colour colour = colour_of_class(static_cast<std::int8_t>(surest));
    EXPECT_EQ(rows[what].colour, (std::array<int, 3>{colour.red, colour.green, colour.blue}))
        << rows[what].name;
  }
}

// Told apart without hue: no two classes that can lie beside one another are of one lightness, but
// for standing things, which differ by what a map says of them.
TEST(ClassPalette, FreeMovingAndStandingDifferInLightness) {
  const std::vector<Row> rows = table_of_page();
  const auto lightness = [&](std::size_t what) {
    const auto& [red, green, blue] = rows.at(what).colour;
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  constexpr std::size_t kFree = 3;
  constexpr std::size_t kMoving = 4;
  constexpr std::size_t kStanding = 6;
  EXPECT_GT(lightness(kFree), lightness(kStanding) + 40);
  EXPECT_GT(lightness(kStanding), lightness(kMoving) + 30);
  EXPECT_GT(lightness(kMoving), lightness(0) + 40);
}

}  // namespace
}  // namespace iog::tools::view
