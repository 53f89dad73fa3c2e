// A track represents one object by a box, a velocity and a state. Hits are assigned to tracks.
#pragma once

#include <array>
#include <cstdint>

#include "objects/covariance.hpp"
#include "objects/plane.hpp"
#include "objects/snapshots.hpp"
#include "objects/step.hpp"

namespace iog::objects {

enum class State : std::uint8_t {
  kNone,     // the slot is free
  kYoung,    // new; its speed is not reported
  kStands,   // no motion was confirmed
  kMoves,    // the grid confirms its motion, so its speed is reported
  kStopped,  // it moved before and is now stationary
};

// The observations of a track in one frame.
struct Seen {
  std::int32_t hits = 0;          // its hits, excluding standing hits
  std::int32_t moving = 0;        // the number of `hits` that the grid classifies as moving
  std::int32_t standing = 0;      // its standing hits
  std::int32_t contradicted = 0;  // hits that are too early to belong to it
  bool is_end_hidden = false;     // it may be longer or wider than its box
  bool has_merged = false;        // it has taken over another track
  // Counts of the places that the track has left or reached. Good places confirm the track's
  // motion, bad places contradict it, and neutral places do neither.
  std::int32_t good = 0;
  std::int32_t bad = 0;
  std::int32_t neutral = 0;
  // Counts of the places that a receding track has left. `passed` is the number of good places that
  // the track's own beams pass. `kept` is the number of bad places that are hit again.
  std::int32_t passed = 0;
  std::int32_t kept = 0;
};

class Track {
 public:
  // Begins a new track with a speed of 0.
  void begin(std::uint32_t id, const Box& box, std::uint64_t now_us);
  void end() { state = State::kNone; }

  [[nodiscard]] bool is_there() const { return state != State::kNone; }
  [[nodiscard]] bool moves() const { return state == State::kMoves; }
  // Returns true if the track is moving or has moved and then stopped.
  [[nodiscard]] bool has_moved() const { return moves() || state == State::kStopped; }

  // Predicts the position and covariance for the next frame.
  void predict(Step step);
  // Corrects the position and speed along one side, given the innovation of the position. Requires
  // |innovation| < 2^17 mm. The speed along `side` changes by at most `most_change` mm/s.
  void correct(Side side, Covariance::Gain gain, std::int32_t innovation_mm,
               std::int32_t most_change = kMostSpeed);
  // Reduces the lateral speed of the box by 1/kWheelsShare.
  void fade_across();
  void rest();  // sets the speed to 0
  // Turns the box without changing the velocity. The direction of the box is arbitrary until the
  // first turn.
  void turn(Direction along) { box_.along = along; }
  // Replaces the sides, and sets the covariances of both axes to their mean. Call begin_heading()
  // after the first turn.
  void begin_heading(const Sides& sides);

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] Sides& sides() { return box_.sides; }
  [[nodiscard]] bool has_heading() const { return has_heading_; }

  [[nodiscard]] const Covariance& covariance(Side side) const { return covariances_[side]; }
  [[nodiscard]] Covariance& covariance(Side side) { return covariances_[side]; }

  // Returns the velocity estimated by the filter. The velocity is unreliable if the track is not
  // moving, because four out of five stationary tracks have a spurious speed.
  [[nodiscard]] Velocity velocity() const { return {vx_ >> kFine, vy_ >> kFine}; }
  // Returns the velocity if the track is moving, and 0 otherwise.
  [[nodiscard]] Velocity believed_velocity() const { return moves() ? velocity() : Velocity{}; }
  [[nodiscard]] std::int32_t speed() const { return speed_; }  // mm/s, rounded down
  // Returns the standard deviation of the speed in mm/s, computed from both axes.
  [[nodiscard]] std::int32_t speed_deviation() const { return speed_deviation_; }
  // Returns true for a slow track that is larger than a pedestrian and has mostly standing hits,
  // unless the track has a trail or is certainly a car. The standing hits may belong to an object
  // that is parked next to the track.
  [[nodiscard]] bool is_mostly_standing() const;
  // Returns true if the track has a heading and is the size of a car.
  [[nodiscard]] bool is_like_a_car() const;
  // Returns true if the track is car-sized and has a high confidence, and if recent frames support
  // its motion. Standing hits in the box of such a track belong to the car. A slow car covers each
  // place for so long that the grid classifies the place as standing. Pedestrians beside a parked
  // car may form a track of the same size, but the cells that they leave are classified as
  // standing.
  [[nodiscard]] bool is_sure_car() const;
  // Updates is_receding from the track's velocity and its position relative to the car.
  void look_from(Point car);
  // Returns true if the track is receding and is larger than a pedestrian. Such an object has
  // already covered the area at its rear for a long time, so hits there may look stationary.
  [[nodiscard]] bool may_have_a_standing_face() const;
  // Updates `trail` from `seen`. Call follow_trail() once per frame.
  void follow_trail();
  // Returns true if beams keep passing the places that the track has left. If so, standing hits may
  // belong to the track.
  [[nodiscard]] bool has_trail() const { return trail >= kTrail; }
  // Returns true if the track has the size and speed of a pedestrian.
  [[nodiscard]] bool is_small() const;
  // Returns true if the track is a streak, that is, a line of hits from a beam that grazes the
  // ground. A real object of the same length has more hits or is wider. A moving track or a group
  // of pedestrians is not classified as a streak merely because its hits are sparse: moving tracks
  // may lose hits, and groups have gaps.
  [[nodiscard]] bool is_streak() const;

  State state = State::kNone;
  std::uint32_t id = 0;       // never reused
  std::uint32_t updates = 0;  // frames in which it was measured
  std::uint64_t born_us = 0;
  std::uint64_t seen_us = 0;     // time of the last measurement
  std::uint64_t slow_us = 0;     // time since which it has been slow; 0 if it is not slow
  std::uint64_t stopped_us = 0;  // time of its last stop; 0 if it has never stopped
  std::int32_t parked_ms = 0;    // time for which most hits in its box have been standing
  std::int32_t confidence = 0;   // confidence that it is moving, 0 ... kMostConfidence
  std::int32_t trail = 0;        // evidence for a trail, 0 ... kMostTrail
  std::int32_t unopposed = 0;    // supporting frames minus deductions, 0 ... kMostUnopposed
  // True if the track is not slow and moves away from the car within about 60 degrees of the line
  // of sight.
  bool is_receding = false;
  Seen seen{};
  Snapshots snapshots{};

 private:
  static constexpr int kFine = 4;  // positions and speeds are in units of 1/16 mm and 1/16 mm/s

  void place();
  void know_speed();

  std::int64_t x_ = 0;
  std::int64_t y_ = 0;
  std::int32_t vx_ = 0;
  std::int32_t vy_ = 0;
  std::int32_t speed_ = 0;
  std::int32_t speed_deviation_ = 0;
  Box box_{};
  std::array<Covariance, 2> covariances_{};
  bool has_heading_ = false;
};

using Tracks = std::array<Track, kMostTracks>;

}  // namespace iog::objects
