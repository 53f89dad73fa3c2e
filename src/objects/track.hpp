// A track: the hits of one object with their box, velocity and state.
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
  kYoung,    // new; its speed is not believed
  kStands,   // no motion was confirmed
  kMoves,    // the grid confirms its motion, so its speed is believed
  kStopped,  // it moved before and stands now
};

// What a frame shows of a track.
struct Seen {
  std::int32_t hits = 0;          // its hits, without standing ones
  std::int32_t moving = 0;        // those of `hits` that the grid classifies as moving
  std::int32_t standing = 0;      // its standing hits
  std::int32_t contradicted = 0;  // hits that came too early to be its own
  bool is_end_hidden = false;     // it may be longer or wider than its box
  // Places that the track has left or reached: they support its motion, speak against it, or
  // neither.
  std::int32_t good = 0;
  std::int32_t bad = 0;
  std::int32_t neutral = 0;
  // Places that a receding track has left: `passed` counts good ones that its own beams pass,
  // `kept` counts bad ones that are hit again.
  std::int32_t passed = 0;
  std::int32_t kept = 0;
};

class Track {
 public:
  // Starts a new track, at rest.
  void begin(std::uint32_t id, const Box& box, std::uint64_t now_us);
  void end() { state = State::kNone; }

  [[nodiscard]] bool is_there() const { return state != State::kNone; }
  [[nodiscard]] bool moves() const { return state == State::kMoves; }
  // It moves, or it moved and has stopped.
  [[nodiscard]] bool has_moved() const { return moves() || state == State::kStopped; }

  // Predicts place and covariance for the next frame.
  void predict(Step step);
  // Applies an innovation of the place along one side, |innovation| < 2^17 mm. The speed along that
  // side changes by at most `most_change` mm/s.
  void correct(Side side, Covariance::Gain gain, std::int32_t innovation_mm,
               std::int32_t most_change = kMostSpeed);
  // Reduces the speed across the box by 1/kWheelsShare.
  void fade_across();
  void rest();  // sets the speed to 0
  // Turns the box; the velocity stays. Until the first turn the direction is arbitrary.
  void turn(Direction along) { box_.along = along; }
  // Call after the first turn. Replaces the sides, and gives both axes the mean of their
  // covariances.
  void begin_heading(const Sides& sides);

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] Sides& sides() { return box_.sides; }
  [[nodiscard]] bool has_heading() const { return has_heading_; }

  [[nodiscard]] const Covariance& covariance(Side side) const { return covariances_[side]; }
  [[nodiscard]] Covariance& covariance(Side side) { return covariances_[side]; }

  // The estimate of the filter. Not reliable if the track is not moving: four of five stationary
  // tracks have a spurious speed.
  [[nodiscard]] Velocity velocity() const { return {vx_ >> kFine, vy_ >> kFine}; }
  // The velocity of a moving track; 0 for any other.
  [[nodiscard]] Velocity believed_velocity() const { return moves() ? velocity() : Velocity{}; }
  [[nodiscard]] std::int32_t speed() const { return speed_; }  // mm/s, rounded down
  // Deviation of the speed over both axes, mm/s.
  [[nodiscard]] std::int32_t speed_deviation() const { return speed_deviation_; }
  // It is larger than a walker, slow, and most of its hits are standing. Those hits may belong to
  // something parked beside it.
  [[nodiscard]] bool is_mostly_standing() const;
  // Whether it has a heading and the size of a car.
  [[nodiscard]] bool is_like_a_car() const;
  // Whether it has the size of a car and a high confidence of moving that nothing opposes. Standing
  // hits in its box are then its own: a slow car covers each place so long that the grid calls it
  // standing. Walkers beside a parked car have the size of a car, too, but leave places that stand.
  [[nodiscard]] bool is_sure_car() const;
  // Sets is_receding from the velocity and the position relative to the car.
  void look_from(Point car);
  // It recedes and is larger than a walker. Standing hits may be its rear, which covered those
  // places for long.
  [[nodiscard]] bool may_have_a_standing_face() const;
  // Updates `trail` from `seen`. Call once per frame.
  void follow_trail();
  // Beams keep passing the places that it has left, so standing hits may be its own.
  [[nodiscard]] bool has_trail() const { return trail >= kTrail; }
  // Whether it has the size and speed of a walker.
  [[nodiscard]] bool is_small() const;
  // Whether it is a streak: a line that a beam draws where it grazes the ground. A real object of
  // that length has more hits or a width. Exceptions are moving tracks, which may lose hits, and
  // groups of walkers, which have gaps.
  [[nodiscard]] bool is_streak() const;

  State state = State::kNone;
  std::uint32_t id = 0;       // never reused
  std::uint32_t updates = 0;  // frames in which it was measured
  std::uint64_t born_us = 0;
  std::uint64_t seen_us = 0;     // time of the last measurement
  std::uint64_t slow_us = 0;     // time since which it is slow; 0: it is not
  std::uint64_t stopped_us = 0;  // time of its last stop; 0: never
  std::int32_t parked_ms = 0;    // for how long most hits in its box have been standing
  std::int32_t confidence = 0;   // confidence that it moves, 0 ... kMostConfidence
  std::int32_t trail = 0;        // evidence for a trail, 0 ... kMostTrail
  std::int32_t unopposed = 0;    // frames that nothing opposes its motion, 0 ... kMostUnopposed
  // Moves away within about 60 degrees of the line of sight, and not slowly.
  bool is_receding = false;
  Seen seen{};
  Snapshots snapshots{};

 private:
  static constexpr int kFine = 4;  // places and speeds are in 1/16 mm and 1/16 mm/s

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
