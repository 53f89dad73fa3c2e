// What the experiments find of M. Kurdej's thesis: the numbers that its page shows, by hand, as it
// prints them, or by an independent program; and how drives are held against the truth.
#include <array>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "lab/experiments/evidential/grids.hpp"
#include "lab/experiments/evidential/roc.hpp"
#include "lab/experiments/experiments.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "value_in.hpp"

namespace iog::lab {
namespace {

namespace thesis = reference::evidential;

double mass_of(const Tables& tables, const char* table, const char* scheme, const char* reading,
               const char* set) {
  return std::stod(
      value_in(tables, "evidential_discounting", "mass",
               {{"of_table", table}, {"scheme", scheme}, {"reading", reading}, {"set", set}}));
}

// alpha 0.3 and 0.2: what is left of {1, 2} is (1 - 0.15)(1 - 0.1) by table 6.1, and 0.7 * 0.8 / 4
// by equation 6.30. All masses of an eighth.
TEST(EvidentialTables, HaveTable61) {
  const Tables tables = evidential_tables({});
  EXPECT_NEAR(8 * mass_of(tables, "6.1", "proportional", "meant", "12"), 0.765, 1e-15);
  EXPECT_NEAR(8 * mass_of(tables, "6.1", "proportional", "printed equations", "12"), 0.14, 1e-15);
  EXPECT_NEAR(mass_of(tables, "6.1", "optimistic", "meant", "frame"), 0.2925, 1e-15);
  EXPECT_NEAR(mass_of(tables, "6.1", "proportional", "meant", "frame"), 0.35125, 1e-15);
  EXPECT_NEAR(mass_of(tables, "6.1", "conservative", "meant", "frame"), 0.4025, 1e-15);
}

TEST(EvidentialTables, HaveTable62) {
  const Tables tables = evidential_tables({});
  for (const char* scheme : {"optimistic", "proportional", "conservative"}) {
    EXPECT_NEAR(mass_of(tables, "6.2", scheme, "meant", "3"), 0.3, 1e-15) << scheme;
    EXPECT_NEAR(mass_of(tables, "6.2", scheme, "meant", "frame"), 0.2, 1e-15) << scheme;
  }
}

// {1}, {1,2}, {3} and the frame. What is left of a class is 2^(-4 s / half-life).
TEST(EvidentialTables, HaveTables63And64) {
  struct Row {
    const char* table;
    const char* scheme;
    const char* reading;
    std::array<double, 4> masses;
  };
  constexpr std::array<Row, 9> kRows{{
      {"6.3", "optimistic", "kappa for alpha", {0.281250, 0.2, 0.033752, 0.384998}},
      {"6.3", "proportional", "kappa for alpha", {0.281250, 0.145313, 0.033752, 0.439685}},
      {"6.3", "conservative", "kappa for alpha", {0.281250, 0.093750, 0.033752, 0.491248}},
      {"6.3", "optimistic", "meant", {0.018750, 0.2, 0.166248, 0.515002}},
      {"6.3", "proportional", "meant", {0.018750, 0.079688, 0.166248, 0.635315}},
      {"6.3", "conservative", "meant", {0.018750, 0.006250, 0.166248, 0.708752}},
      {"6.4", "proportional", "kappa for alpha", {0.127695, 0.106924, 0.033752, 0.631629}},
      {"6.4", "conservative", "meant", {0.172305, 0.057435, 0.166248, 0.504013}},
      {"6.4", "contextual", "meant", {0.172305, 0.139137, 0.166248, 0.198264}},
  }};
  constexpr std::array kSets{"1", "12", "3", "frame"};
  const Tables tables = evidential_tables({});
  for (const Row& row : kRows) {
    for (std::size_t i = 0; i < kSets.size(); ++i) {
      EXPECT_NEAR(mass_of(tables, row.table, row.scheme, row.reading, kSets[i]), row.masses[i],
                  1e-6)
          << row.table << ", " << row.scheme << ", " << row.reading << ", " << kSets[i];
    }
  }
}

// "At iteration 12 and 10": with the rates of table 7.1 exchanged, not as they are printed. The
// masses of figure 5.6 were computed once by a program of its own.
TEST(EvidentialCell, HasFigures56And57) {
  const Tables tables = evidential_cell({});
  for (const char* context : {"road", "intermediate"}) {
    const auto stop = [&](const char* rates, const char* gain) {
      return value_in(
          tables, "evidential_stops", "scan",
          {{"context", context}, {"ageing", "conservative"}, {"rates", rates}, {"gain", gain}});
    };
    EXPECT_EQ(stop("exchanged", "0.05"), "12");
    EXPECT_EQ(stop("exchanged", "0.15"), "10");
    EXPECT_EQ(stop("as printed", "0.05"), "14");
    EXPECT_EQ(stop("as printed", "0.15"), "11");
    const auto mass = [&](const char* scan, const char* column) {
      return std::stod(value_in(tables, "evidential_curves", column,
                                {{"context", context}, {"gain", "0.05"}, {"scan", scan}}));
    };
    EXPECT_NEAR(mass("6", "moving"), 0.689420, 1e-6);
    EXPECT_NEAR(mass("10", "movable"), 0.373315, 1e-6);
    EXPECT_NEAR(mass("24", "standing"), 0.993968, 1e-6);
    EXPECT_NEAR(mass("24", "accumulator"), 0.761446, 1e-6);
    EXPECT_NEAR(mass("25", "ignorance"), 0.307586, 1e-6);
    EXPECT_NEAR(mass("30", "free"), 0.949374, 1e-6);
  }
}

// Two echoes of one cell: 0.8, or 1 - 0.2^2; a cell between echoes is unknown.
TEST(EvidentialCell, HasTheLidarModels) {
  const Tables tables = evidential_cell({});
  const auto mass = [&](const char* model, const char* cell_m, const char* column) {
    return std::stod(value_in(tables, "evidential_lidar_models", column,
                              {{"model", model}, {"sigma_m", "0.1"}, {"cell_from_m", cell_m}}));
  };
  EXPECT_NEAR(mass("multi-echo", "5", "occupied"), 0.80, 1e-15);
  EXPECT_NEAR(mass("reinforced", "5", "occupied"), 0.96, 1e-15);
  EXPECT_EQ(mass("reinforced", "4", "free") + mass("reinforced", "4", "occupied"), 0);
  EXPECT_GT(mass("imprecise", "4.5", "occupied"), 0.1);
}

TEST(EvidentialMap, AgreesWhereItIsProven) {
  const Tables tables = evidential_map({});
  for (const char* context : {"none", "road", "intermediate", "building"}) {
    for (const char* ageing : {"classical", "conservative", "optimistic", "proportional"}) {
      const auto value = [&](const char* column) {
        return std::stod(
            value_in(tables, "evidential_map_order", column,
                     {{"context", context}, {"ageing", ageing}, {"specialised", "occupied sets"}}));
      };
      const bool is_open = std::string(context) != "building";
      const bool has_map = std::string(context) != "none";
      const bool agrees = is_open && (!has_map || std::string(ageing) != "proportional");
      EXPECT_EQ(value("difference") < 1e-12, agrees) << context << ", " << ageing;
      EXPECT_EQ(value("sets_not_kept_by_scan"), 0);
      EXPECT_EQ(value("sets_not_kept_by_ageing") == 0, agrees || !is_open) << context << ageing;
      EXPECT_EQ(value("added_by_a_scan") < 1e-12, is_open) << context;
    }
  }
}

// By an independent program: betP of free after a hundred scans of 0.7.
TEST(EvidentialMap, NeverFreesAGhostThatSpeaksInEveryScan) {
  const Tables tables = evidential_map({});
  const auto free = [&](const char* map, const char* belief, const char* column) {
    return std::stod(value_in(tables, "evidential_ghost", column,
                              {{"map", map}, {"belief", belief}, {"scan", "100"}}));
  };
  EXPECT_NEAR(free("every scan", "0.97", "free"), 0.0277, 5e-5);
  EXPECT_NEAR(free("every scan", "0.99", "free"), 0.0084, 5e-5);
  EXPECT_NEAR(free("decision", "0.97", "free"), 0.4176, 5e-5);
  EXPECT_NEAR(free("decision", "0.99", "free"), 0.1919, 5e-5);
  // m' = 0.7 + 0.3 * 0.9 m has its fixed point at 0.7 / 0.73.
  EXPECT_NEAR(free("decision", "0.97", "free_mass"), 0.7 / 0.73, 1e-12);
  const auto alone = [&](const char* scan) {
    return std::stod(
        value_in(tables, "evidential_map_alone", "mass", {{"belief", "0.97"}, {"scan", scan}}));
  };
  EXPECT_NEAR(alone("2"), 0.995928, 1e-6);
  EXPECT_NEAR(alone("3"), 0.996621, 1e-6);
}

// A lidar in the middle of a cell of 10 by 10 m looks along x. Its three middle sectors have an
// echo in the middle of a cell 3.5 m ahead; half a metre to the side of that is 8 degrees away.
TEST(SourceMasses, AreWhereTheLidarLooks) {
  LidarScan lidar;
  lidar.at = {.x = 105.25, .y = 205.25};
  lidar.echoes_m.resize(201, {60.0});
  lidar.echoes_m[99] = lidar.echoes_m[100] = lidar.echoes_m[101] = {3.75};
  DriveScan scan;
  scan.lidars = {lidar};
  const Region region{.x_low_m = 100, .y_low_m = 200, .cell_m = 0.5, .side = 20};
  const auto masses = source_masses(scan, region, {});
  const auto at = [&](double x_m, double y_m) { return masses[region.cell_of({x_m, y_m})]; };
  EXPECT_NEAR(at(107.3, 205.3).free, 0.7, 1e-12);
  EXPECT_NEAR(at(107.3, 207.2).free, 0.7, 1e-12);  // 44 degrees to the left
  EXPECT_EQ(at(107.3, 208.2).free, 0);             // 56
  EXPECT_EQ(at(102.3, 205.2).free, 0);             // behind it
  // 3.5 m are between the middles of the cells of 3.0 to 3.5 and 3.5 to 4.0 m.
  EXPECT_NEAR(at(108.8, 205.3).occupied, 0.4, 1e-12);
  EXPECT_NEAR(at(108.8, 205.3).free, 0.35, 1e-12);
  EXPECT_EQ(at(108.8, 205.8).occupied, 0);
  EXPECT_EQ(at(109.8, 205.3).occupied + at(109.8, 205.3).free, 0);  // behind the echo
}

// The scene's own houses, carriageway and what is between; a ghost goes before all of them.
TEST(SceneMap, KnowsWhereThingsAre) {
  tools::Drive drive(tools::find_vehicle(tools::kDefaultVehicle), 21, 1, tools::find_scene("city"),
                     tools::Motion::kContinuous);
  SceneMap map(drive.scene());
  const auto at = [&](double station, double left) {
    const tools::Placement place = drive.scene().road.at(station, left);
    return map.classes_at({place.x, place.y});
  };
  for (const double left : {-5.7, 0.0, 5.7}) {
    EXPECT_EQ(at(10, left), thesis::kRoad) << left;
  }
  EXPECT_EQ(at(10, 7.5), thesis::kIntermediate);
  EXPECT_EQ(at(10, -7.5), thesis::kIntermediate);
  EXPECT_EQ(at(53, 12), thesis::kRoad);  // the first junction (docs/drives.md: 45 m ahead, 16 wide)
  const tools::Placement here = drive.scene().road.at(10, 0);
  map.add_ghost(tools::box(tools::Material::kWall, here, 4, 4, 0, 3));
  EXPECT_EQ(at(10, 0), thesis::kBuilding);
}

TEST(OnWhat, TellsWhatCanMoveFromWhatCannot) {
  const TrueThing car{TrueState::kStanding, 1, tools::Material::kCar};
  EXPECT_EQ(on_what(car, thesis::kRoad), On::kStopped);
  EXPECT_EQ(on_what(car, thesis::kIntermediate), On::kBeside);
  EXPECT_EQ(on_what({TrueState::kStanding, 1, tools::Material::kWall}, thesis::kRoad), On::kHouse);
  EXPECT_EQ(on_what({TrueState::kStanding, 1, tools::Material::kPole}, thesis::kRoad), On::kBeside);
  EXPECT_EQ(on_what({TrueState::kMovingCar, 1, tools::Material::kCar}, thesis::kRoad),
            On::kMovingCar);
  EXPECT_EQ(on_what({}, thesis::kRoad), On::kNothing);
}

TEST(Words, OfAGridWithoutAMapAreCompletedByOne) {
  using decision::Class;
  EXPECT_EQ(word_of(Class::kFree, thesis::kRoad), Word::kDrivable);
  EXPECT_EQ(word_of(Class::kFree, thesis::kBuilding), Word::kNonDrivable);
  EXPECT_EQ(word_of(Class::kFree, thesis::kRoad | thesis::kIntermediate), Word::kFree);
  EXPECT_EQ(word_of(Class::kStoppedOrUnmapped, thesis::kRoad), Word::kStopped);
  EXPECT_EQ(word_of(Class::kStoppedOrUnmapped, thesis::kIntermediate), Word::kStanding);
  EXPECT_EQ(word_of(Class::kStoppedOrUnmapped, thesis::kBuilding), Word::kMapped);
  EXPECT_EQ(word_of(Class::kMoving, thesis::kBuilding), Word::kMoving);
  EXPECT_EQ(word_of(Class::kUnknown, thesis::kRoad), Word::kUnknown);
  EXPECT_EQ(word_of(thesis::kStopped), Word::kStopped);
  EXPECT_EQ(word_of(thesis::Set{0}), Word::kUnknown);
}

// An echo is on something, but for noise; the grid that says one word is counted so.
TEST(Scores, CountWhatIsSaid) {
  const EvidentialDrive drive("city", 5, 2, 1, 40);
  ASSERT_FALSE(drive.truth.empty());
  Scores scores;
  std::size_t echoes = 0;
  for (const auto& [frame, truth] : drive.truth) {
    EXPECT_EQ(frame % 10, 9U);
    scores.add(truth, [](const TruePoint&) { return Word::kMoving; });
    echoes += truth.echoes.size();
  }
  std::uint64_t all = 0;
  for (const auto& counts : scores.echoes) {
    for (std::size_t word = 0; word < kWordCount; ++word) {
      EXPECT_TRUE(counts[word] == 0 || word == static_cast<std::size_t>(Word::kMoving));
      all += counts[word];
    }
  }
  EXPECT_EQ(all, echoes);
  const auto on_nothing = scores.echoes[0][static_cast<std::size_t>(Word::kMoving)];
  EXPECT_LT(static_cast<double>(on_nothing), 0.05 * static_cast<double>(echoes));
}

// Each threshold has what scores at least as much; a byte scores by its mass.
TEST(Curve, CountsWhatReachesEachThreshold) {
  Curve curve;
  curve.add(true, 0);
  curve.add(true, 0.505);
  curve.add(true, 1);
  curve.add(false, 0.29);  // which is below 29 hundredths in binary
  const std::vector<std::array<std::size_t, 3>> expected{
      {0, 3, 1}, {1, 2, 1}, {29, 2, 1}, {30, 2, 0}, {50, 2, 0}, {51, 1, 0}, {100, 1, 0}};
  for (const auto& [hundredths, of_class, others] : expected) {
    const Curve::Counts counts = curve.at_least(hundredths);
    EXPECT_EQ(counts.of_class, of_class) << hundredths;
    EXPECT_EQ(counts.others, others) << hundredths;
  }
}

TEST(Curve, AByteScoresTheMiddleOfItsMass) {
  EXPECT_EQ(score_of(8 * 4 + 3, 3), 0);
  EXPECT_EQ(score_of(0, 4), 0);
  EXPECT_NEAR(score_of(8 * 4, 4), (16'384 + 1'024) / 32'767.0, 1e-12);
  EXPECT_NEAR(score_of(8 * 4 + 7, 4), (16'384 + 7 * 2'048 + 1'024) / 32'767.0, 1e-12);
}

TEST(Curves, AskEchoesWhatMovesAndGroundWhereOneMayDrive) {
  Curves curves;
  const auto at = [](On on, thesis::Set map) {
    TruePoint point{};
    point.on = on;
    point.map_classes = map;
    return point;
  };
  const TrueScan truth{
      .echoes = {at(On::kMovingCar, thesis::kRoad), at(On::kMovingPerson, thesis::kIntermediate),
                 at(On::kHouse, thesis::kBuilding), at(On::kSettling, thesis::kRoad),
                 at(On::kNothing, thesis::kRoad)},
      .ground = {at(On::kNothing, thesis::kRoad), at(On::kNothing, thesis::kIntermediate),
                 at(On::kStopped, thesis::kRoad)}};
  curves.add(
      truth, [](const TruePoint&) { return 0.5; }, [](const TruePoint&) { return 0.5; });
  EXPECT_EQ(curves.moving.all().of_class, 2U);
  EXPECT_EQ(curves.moving.all().others, 1U);
  EXPECT_EQ(curves.drivable.all().of_class, 1U);
  EXPECT_EQ(curves.drivable.all().others, 2U);
  EXPECT_EQ(curves.drivable.at_least(51).of_class, 0U);
}

// What a grid holds of a cell is named by the core's own decision.
TEST(OurWord, AsksMassesWithoutIgnorance) {
  thesis::PerceptionGrid grid(std::array{thesis::kRoad, thesis::kBuilding, thesis::kRoad},
                              thesis::MapOrder::kAtDecision, 0.97, {});
  grid.scan(std::array{thesis::SourceMass{.free = 0.7}, thesis::SourceMass{.free = 0.7},
                       thesis::SourceMass{}});
  EXPECT_EQ(our_word(grid, 0, thesis::kRoad), Word::kDrivable);
  EXPECT_EQ(our_word(grid, 1, thesis::kBuilding), Word::kNonDrivable);
  EXPECT_EQ(our_word(grid, 2, thesis::kRoad), Word::kUnknown);
  EXPECT_EQ(pignistic_word(grid, 1), Word::kMapped);
}

}  // namespace
}  // namespace iog::lab
