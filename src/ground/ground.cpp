#include "ground/ground.hpp"

#include "ground/fan.hpp"
#include "require/require.hpp"

namespace iog::ground {

void Ground::begin(const vehicle::Sensor& sensor) {
  sensor_ = &sensor;
  beams_ = Beams(sensor);
  limits_ = {.low_mm = sensor.ground.low_mm, .top_mm = sensor.ground.top_mm};
  const vehicle::MovedLimits& moved = sensor.moved;
  low_mm_ = moved.low_mm;
  tall_mm_ = moved.tall_mm;
  is_always_low_ = moved.low_mm == vehicle::MovedLimits::kAnyHeight;
  forget();
}

void Ground::close_turn(SurfaceWalk& walk, const Lows& lows) {
  walk.close_turn(beams_.bins(), lows, surface_);
  find_exits();
}

void Ground::forget() {
  surface_.forget();
  find_exits();
}

void Ground::find_exits() {
  Fan fan(beams_, *sensor_);
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    fan.turn_to(sector);
    exits_.find(sector, fan, limits_, surface_);
    if (!is_always_low_) {
      low_beams_.find(sector, fan, low_mm_, surface_);
    }
  }
}

Grounds::Grounds(const vehicle::Vehicle& vehicle) : vehicle_(&vehicle) {
  places_.fill(kNone);
  std::uint8_t place = 0;
  for (std::size_t i = 0; i < vehicle.sensors.size(); ++i) {
    if (vehicle.sensors[i].ground.is_followed()) {
      require(place < grounds_.size());
      grounds_[place].begin(vehicle.sensors[i]);
      places_[i] = place++;
    }
  }
}

Grounds::LowsAre Grounds::end_frame(std::size_t sensor, std::uint32_t swept_ticks) {
  const std::size_t place = places_[sensor];
  Turn& turn = turns_[place];
  if (swept_ticks == 0) {
    const bool was_silent = turn.silent_us >= kForgottenUs;
    turn.silent_us += was_silent ? 0 : vehicle_->frame_period_us;
    if (was_silent || turn.silent_us < kForgottenUs) {
      return LowsAre::kKept;
    }
    turn.swept_ticks = 0;
    grounds_[place].forget();
    return LowsAre::kForgotten;
  }
  turn.silent_us = 0;
  turn.swept_ticks += swept_ticks;
  if (turn.swept_ticks < vehicle_->sensors[sensor].scan_width_ticks) {
    return LowsAre::kKept;
  }
  turn.swept_ticks = 0;
  return LowsAre::kOfTurn;
}

}  // namespace iog::ground
