#include "tools/simulate/world/attitude.hpp"

#include <cmath>

#include "numeric/elementary.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

constexpr double kTurn = 2 * numeric::kPi;
constexpr double kDegree = numeric::kPi / 180;
constexpr std::uint64_t kBumpStream = 500;  // of the world's own, each stretch one
constexpr std::uint64_t kBrakeStream = 100'000;

// A stretch of bumps in each 4 s, over which the body swings for 2 s.
constexpr double kBumpEveryS = 4;
constexpr double kBumpLastsS = 2;
constexpr double kPitchHertz = 0.95;
constexpr double kRollHertz = 0.85;

constexpr double kBrakeEveryS = 9;
constexpr double kBrakeLastsS = 2.5;
constexpr double kBrakeRampS = 0.8;
constexpr double kBrakeDeg = 0.5;

// A swing that grows and dies away. since_s: after its begin.
double swing(double since_s, double hertz) {
  return numeric::sin(kTurn / 2 * since_s / kBumpLastsS) * numeric::sin(kTurn * hertz * since_s);
}

void add_bumps(std::uint64_t seed, double time_s, Lean& lean) {
  const double number = std::floor(time_s / kBumpEveryS);
  Random random(seed, kBumpStream + static_cast<std::uint64_t>(number));
  const double begin_s = number * kBumpEveryS + random.between(0, kBumpEveryS - kBumpLastsS);
  const double pitch_deg = random.between(0.5, 1.45);
  const double roll_deg = random.between(0.5, 1.8) * (random.chance(0.5) ? 1 : -1);
  const double since_s = time_s - begin_s;
  if (since_s > 0 && since_s < kBumpLastsS) {
    lean.pitch -= pitch_deg * kDegree * swing(since_s, kPitchHertz);
    lean.roll += roll_deg * kDegree * swing(since_s, kRollHertz);
    lean.heave_m += 0.03 * swing(since_s, kPitchHertz);
  }
}

// The nose goes down and up again without a jerk.
void add_brake(std::uint64_t seed, double time_s, Lean& lean) {
  const double number = std::floor(time_s / kBrakeEveryS);
  Random random(seed, kBrakeStream + static_cast<std::uint64_t>(number));
  const double since_s =
      time_s - number * kBrakeEveryS - random.between(0, kBrakeEveryS - kBrakeLastsS);
  const double ramp = std::fmin(since_s, kBrakeLastsS - since_s) / kBrakeRampS;
  if (ramp > 0) {
    lean.pitch += kBrakeDeg * kDegree * (ramp < 1 ? ramp * ramp * (3 - 2 * ramp) : 1);
  }
}

}  // namespace

Lean Attitude::at(double time_s) const {
  Lean lean;
  if (time_s > 0) {
    add_bumps(seed_, time_s, lean);
    add_brake(seed_, time_s, lean);
  }
  return lean;
}

}  // namespace iog::tools
