// Every mistake that a car's file can have is told with its line, its field, and what is allowed
// there: mistakes.txt has them, as changes to car.toml.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "tools/program/exit_status.hpp"
#include "tools/vehicles/car_file.hpp"

namespace iog::tools {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(std::istream&& in) {
  Lines lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

Lines lines_of_file(const std::string& name) {
  return lines_of(std::ifstream(IOG_SOURCE_DIR "/tests/host/vehicles/" + name));
}

std::string key_of(const std::string& line) { return line.substr(0, line.find(' ')); }

// car.toml and what is changed of it. Blank lines are between its parts.
class CarText {
 public:
  CarText() {
    for (const std::string& line : lines_of_file("car.toml")) {
      if (line.empty()) {
        parts_.emplace_back();
      } else {
        parts_.back().push_back(line);
      }
    }
  }

  void change(const std::string& part, const std::string& line) {
    const auto number = std::ranges::find(kParts, part) - kParts.begin();
    Lines& lines = parts_.at(static_cast<std::size_t>(number));
    const auto place = std::ranges::find(lines, key_of(line), key_of);
    if (line.empty()) {
      lines.clear();
    } else if (place == lines.end()) {
      lines.push_back(line);
    } else if (line == key_of(line)) {
      lines.erase(place);
    } else {
      *place = line;
    }
  }

  [[nodiscard]] std::string text() const {
    std::string text;
    for (const Lines& part : parts_) {
      text += text.empty() ? "" : "\n";
      for (const std::string& line : part) {
        text += line + '\n';
      }
    }
    return text;
  }

 private:
  static inline const Lines kParts{"car", "front", "roof", "network"};

  std::vector<Lines> parts_ = std::vector<Lines>(1);
};

// What stands behind "car.toml:" in each line.
Lines told_of(const std::string& text) {
  const std::string file = "car.toml";
  Lines lines;
  try {
    static_cast<void>(parse_car(text, file));
  } catch (const UsageError& error) {
    lines = lines_of(std::istringstream(error.what()));
  }
  for (std::string& line : lines) {
    EXPECT_TRUE(line.starts_with(file + ':')) << line;
    line.erase(0, file.size() + 1);
  }
  return lines;
}

// One of mistakes.txt.
struct Mistake {
  Lines changes;
  Lines told;
};

std::vector<Mistake> all_mistakes() {
  std::vector<Mistake> all;
  for (const std::string& line : lines_of_file("mistakes.txt")) {
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    const bool is_told = line.starts_with("  ");
    if (!is_told && (all.empty() || !all.back().told.empty())) {
      all.emplace_back();
    }
    Lines& lines = is_told ? all.back().told : all.back().changes;
    lines.push_back(line.substr(is_told ? 2 : 0));
  }
  return all;
}

std::string with_fifteen_lasers(std::string line) {
  constexpr std::string_view kPlace = "<15>";
  if (const auto at = line.find(kPlace); at != std::string::npos) {
    std::string lasers;
    for (int elevation_deg = -8; elevation_deg < 7; ++elevation_deg) {
      lasers += (lasers.empty() ? "{ elevation_deg = " : ", { elevation_deg = ") +
                std::to_string(elevation_deg) + " }";
    }
    line.replace(at, kPlace.size(), lasers);
  }
  return line;
}

void expect_told(const Mistake& mistake) {
  CarText car;
  for (const std::string& change : mistake.changes) {
    const std::size_t colon = change.find(':');
    const std::string part = change.substr(0, colon);
    const std::string line = change.substr(std::min(colon + 2, change.size()));
    car.change(part, with_fifteen_lasers(line));
  }
  const Lines told = told_of(car.text());
  EXPECT_EQ(told.size(), mistake.told.size());
  for (std::size_t i = 0; i < std::min(told.size(), mistake.told.size()); ++i) {
    EXPECT_EQ(told[i].substr(0, mistake.told[i].size()), mistake.told[i]);
  }
}

TEST(CarMistakes, ACarWithoutOneIsReadWhateverItsNameAndItsFiles) {
  EXPECT_EQ(told_of(CarText().text()), Lines{});
  for (const std::string name : {"class", "vehicle", "my__car", "_"}) {
    CarText car;
    car.change("car", "name = \"" + name + '"');
    EXPECT_EQ(told_of(car.text()), Lines{});
  }
}

TEST(CarMistakes, EachIsToldWithItsLineItsFieldAndWhatIsAllowed) {
  const std::vector<Mistake> all = all_mistakes();
  EXPECT_GT(all.size(), 80U);
  for (const Mistake& mistake : all) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, mistake.changes.front());
    expect_told(mistake);
  }
}

// What depends on it has the value of a car that does not say it, which is no mistake.
TEST(CarMistakes, AValueThatCannotBeReadIsTheOnlyOne) {
  for (const std::string change :
       {"car: name", "car: z_min_m", "car: z_max_m", "car: footprint", "front: name", "front: type",
        "front: udp_port", "front: mount", "front: max_points_per_scan", "roof: type"}) {
    CarText car;
    const std::size_t colon = change.find(':');
    car.change(change.substr(0, colon), change.substr(colon + 2) + " = true");
    car.change("car", "footprint_m = 3");
    const Lines told = told_of(car.text());
    EXPECT_EQ(told.size(), 2U) << change << ": " << told.back();
  }
}

TEST(CarMistakes, NineSensorsAreTooMany) {
  std::string text = CarText().text();
  for (int i = 0; i < 7; ++i) {
    text += "[[sensors]]\nname = \"lux" + std::to_string(i) +
            "\"\ntype = \"ibeo_lux\"\nudp_port = " + std::to_string(13'000 + i) +
            "\nmount = { x_m = 0.0, y_m = 0.0, z_m = 0.5 }\nmax_points_per_scan = 804\n";
  }
  EXPECT_EQ(told_of(text), Lines{"6: sensors: allowed is 1 ... 8 of them"});
}

// A wrong file of a gigabyte is not told line by line.
TEST(CarMistakes, OfManyTheFirstAreToldAndTheOthersCounted) {
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    text += "key_" + std::to_string(i) + " = 1\n";
  }
  const Lines told = told_of(text);
  ASSERT_EQ(told.size(), 51U);
  // Three keys of a car are missing as well.
  EXPECT_EQ(told.back(), " and 953 more");
  EXPECT_TRUE(told[40].starts_with("38: key_37: no such key"));
}

TEST(CarMistakes, AFileThatIsNotThereIsTold) {
  EXPECT_THROW(static_cast<void>(read_car("nowhere/my_car.toml")), UsageError);
}

}  // namespace
}  // namespace iog::tools
