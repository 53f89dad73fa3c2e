// What the classes say of the returns of a simulated drive, against what is true of each of them.
//
// A return counts by the frame that takes it, and by the cell that the target marks for it. Of
// things count returns that are truly kLowestM to kHighestM over the ground below them: inside of
// the limits over the ground, by more than a range is off.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "lab/evaluation/perception.hpp"
#include "lab/experiments/hills/fate_watch.hpp"
#include "lab/experiments/keyed_car.hpp"
#include "lab/experiments/perceiver.hpp"
#include "placing/placement.hpp"
#include "pose/slice.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/truth/true_ground.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

inline constexpr double kLowestM = 0.35;
inline constexpr double kHighestM = 2.10;

enum class What : std::uint8_t {
  kRoad,      // from kerb to verge
  kBeside,    // ground beside it: pavements, verges, banks
  kStanding,  // what stands, whether it could move or not
  kMoving,
};

// What a return is of; ground has the material of ground alone. is_marked: the target takes it for
// an obstacle.
struct ReturnOn {
  What what = What::kRoad;
  tools::Material material = tools::Material::kGround;
  bool is_marked = false;
  friend auto operator<=>(const ReturnOn&, const ReturnOn&) = default;
};

// How far from the car's origin: nearer than these, or farther.
inline constexpr std::array<double, 3> kReturnRangesM{15, 25, 50};
inline constexpr std::size_t kReturnRangeCount = kReturnRangesM.size() + 1;

using ReturnScores = std::map<ReturnOn, std::array<SaidCounts, kReturnRangeCount>>;

// The returns of one packet that count.
struct SeenReturn {
  std::size_t point = 0;  // its number in its packet
  geometry::Cell cell{};  // of the vehicle's grid
  std::uint8_t range = 0;
  ReturnOn on{};  // not yet whether it is marked
};
struct SeenPacket {
  tools::CapturedDatagram datagram;
  pose::Slice slice{};
  std::vector<SeenReturn> returns;
};

// Makes them of the packets of a drive.
class Seen {
 public:
  // vehicle outlives it.
  Seen(const vehicle::Vehicle& vehicle, const tools::Scene& scene)
      : vehicle_(&vehicle), ground_(scene.plan) {}

  // The things of the world as they are now.
  void look(const tools::Drive& drive, std::uint32_t frame);
  [[nodiscard]] SeenPacket of(tools::SimulatedPacket&& packet) const;

 private:
  // Nothing: it does not count.
  [[nodiscard]] std::optional<ReturnOn> on(const tools::PointTruth& truth) const;

  const vehicle::Vehicle* vehicle_;
  tools::TrueGround ground_;
  std::map<std::uint32_t, tools::Material> materials_;  // of a thing's first solid
};

// A target with one setting. It is not moved while it lives.
class Listener {
 public:
  Listener(const vehicle::Vehicle& car, const Keys& keys, std::uint64_t scored_from_us);

  void take(const tools::CapturedDatagram& pose) { perceiver_.take(pose); }
  void take(const SeenPacket& packet);

  [[nodiscard]] const ReturnScores& scores() const { return scores_; }
  // Packets whose slices were never placed.
  [[nodiscard]] std::uint32_t packets_lost() const {
    return lost_ + static_cast<std::uint32_t>(waiting_.size());
  }

 private:
  struct Waiting {
    std::uint64_t time_us = 0;
    pose::Slice slice{};
    std::vector<SeenReturn> returns;
    bool is_taken = false;  // it is in a frame
  };
  static constexpr std::uint64_t kLostUs = 1'000'000;

  void note_taken();
  void score_frame(const Perceiver& perceiver);
  void score(const Waiting& packet, const placing::CellMap& to_window,
             std::span<const std::int8_t> classes);

  KeyedCar car_;
  std::uint64_t scored_from_us_;
  FateWatch fates_;
  std::deque<Waiting> waiting_;
  ReturnScores scores_;
  std::uint32_t lost_ = 0;
  Perceiver perceiver_;
};

}  // namespace iog::lab
