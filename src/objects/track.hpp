// A track: hits that are taken for one thing, its box, its speed, and whether that is believed.
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
  kYoung,    // something; its speed is not believed
  kStands,   // something that has shown no motion
  kMoves,    // its speed is believed
  kStopped,  // it has moved, and stands
};

// What a frame has said of a track.
struct Seen {
  std::int32_t hits = 0;          // that are its own, but for those that stand
  std::int32_t moving = 0;        // of them, those that the grid calls moving
  std::int32_t standing = 0;      // its own that stand
  std::int32_t contradicted = 0;  // that it would have taken, had something not been there before
  bool is_end_hidden = false;     // it may be longer or wider than its box
  // Places that it has left or come to: that say that it moves, that it does not, or neither.
  std::int32_t good = 0;
  std::int32_t bad = 0;
  std::int32_t neutral = 0;
  // Of places that a receding thing has left: of the good those that its own beams pass, of the bad
  // those that are hit again.
  std::int32_t passed = 0;
  std::int32_t kept = 0;
};

class Track {
 public:
  // One that is seen for the first time: it rests.
  void begin(std::uint32_t id, const Box& box, std::uint64_t now_us);
  void end() { state = State::kNone; }

  [[nodiscard]] bool is_there() const { return state != State::kNone; }
  [[nodiscard]] bool moves() const { return state == State::kMoves; }
  // It moves, or has moved and stopped.
  [[nodiscard]] bool has_moved() const { return moves() || state == State::kStopped; }

  // Where it is a step later, and how sure.
  void predict(Step step);
  // Takes over an innovation of its place along one side, |innovation| < 2^17 mm. Its speed along
  // that side changes by at most so many mm/s.
  void correct(Side side, Covariance::Gain gain, std::int32_t innovation_mm,
               std::int32_t most_change = kMostSpeed);
  // One part in kWheelsShare of its speed across is taken away.
  void fade_across();
  void rest();  // its speed is 0
  // The box turns, its velocity stays. At first along is any direction.
  void turn(Direction along) { box_.along = along; }
  // It has turned for the first time, and its sides are taken anew: it is as sure of one as of the
  // other.
  void begin_heading(const Sides& sides);

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] Sides& sides() { return box_.sides; }
  [[nodiscard]] bool has_heading() const { return has_heading_; }

  [[nodiscard]] const Covariance& covariance(Side side) const { return covariances_[side]; }
  [[nodiscard]] Covariance& covariance(Side side) { return covariances_[side]; }

  // What the filter says, believed or not: four of five tracks of what stands have one.
  [[nodiscard]] Velocity velocity() const { return {vx_ >> kFine, vy_ >> kFine}; }
  // That of what moves; of any other 0.
  [[nodiscard]] Velocity believed_velocity() const { return moves() ? velocity() : Velocity{}; }
  [[nodiscard]] std::int32_t speed() const { return speed_; }  // mm/s, rounded down
  // Of the speed along both sides together, mm/s.
  [[nodiscard]] std::int32_t speed_deviation() const { return speed_deviation_; }
  // It is larger than a walker, slow, and most of its hits stand: it may be beside something that
  // is parked, and the hits that stand are not known to be its own.
  [[nodiscard]] bool is_mostly_standing() const;
  // By its heading and its box.
  [[nodiscard]] bool is_like_a_car() const;
  // It is, and has been shown to move for so long that what stands within it is its own: its body
  // was above those places long enough for the grid to call them standing.
  [[nodiscard]] bool is_sure_car() const;
  // Sets is_receding, by its velocity and where it is from the car.
  void look_from(Point car);
  // It recedes and is larger than a walker: standing hits may be its rear, which was above that
  // place for long.
  [[nodiscard]] bool may_have_a_standing_face() const;
  // Updates the trail from `seen`, once a frame.
  void follow_trail();
  // Beams keep passing the places that it has left, so standing hits may be its own.
  [[nodiscard]] bool has_trail() const { return trail >= kTrail; }
  // A walker, by size and speed.
  [[nodiscard]] bool is_small() const;
  // What a beam draws where it grazes the ground is long and of few hits: a thing so long has more
  // of them, or a width. What is known to move may lose hits, and walkers leave gaps.
  [[nodiscard]] bool is_streak() const;

  State state = State::kNone;
  std::uint32_t id = 0;       // never used again
  std::uint32_t updates = 0;  // frames in which it was measured
  std::uint64_t born_us = 0;
  std::uint64_t seen_us = 0;     // it was measured last
  std::uint64_t slow_us = 0;     // since when it is slow; 0: it is not
  std::uint64_t stopped_us = 0;  // when it stopped last; 0: never
  std::int32_t parked_ms = 0;    // for how long most of what is in its box stands
  std::int32_t confidence = 0;   // that it moves, 0 ... kMostConfidence
  std::int32_t trail = 0;        // that it leaves a trail, 0 ... kMostTrail
  bool is_receding = false;      // within about 60 degrees of the line of sight, and not slow
  Seen seen{};
  Snapshots snapshots{};

 private:
  static constexpr int kFine = 4;  // places and speeds in sixteenths

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
