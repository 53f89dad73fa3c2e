#include "tools/mount/mount_words.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "lidar/formats.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

// As short as it can be read again.
std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string thousandths(double value) { return shortest(std::round(value * 1000) / 1000 + 0.0); }

std::string words_of(const FittedValue& fitted, double by_file) {
  std::string words = thousandths(fitted.value) + ", the car's file says " + shortest(by_file) +
                      "; in three parts of the recording";
  for (const double part : fitted.parts) {
    words += " " + fixed(part, 3);
  }
  return words + ", single turns differ by " + fixed(fitted.scatter, 3);
}

// An angle that is the file's but for its sign. Those near 0 or half a turn may be so by chance.
std::string words_of_sign(const std::string& key, double found, double by_file) {
  constexpr double kLeastDeg = 2;
  const auto from_multiple_of = [](double of_deg, double angle_deg) {
    return std::abs(std::remainder(angle_deg, of_deg));
  };
  const bool is_turned =
      from_multiple_of(180, by_file) >= kLeastDeg &&
      4 * from_multiple_of(360, found + by_file) < from_multiple_of(360, found - by_file);
  return is_turned ? row("SIGN?", key +
                                      " of the car's file has the wrong sign; pitch_deg is "
                                      "positive down, roll_deg to the right")
                   : std::string();
}

std::string words_of_turns(const MountFit& fit, const UnitTurns& unit) {
  const auto count = [&](CarState state) { return fit.turns[static_cast<std::size_t>(state)]; };
  std::string words = std::to_string(fit.taken) + " of " + std::to_string(unit.turns());
  if (const std::size_t hidden = unit.turns() - unit.mounts().size(); hidden > 0) {
    words += ", " + std::to_string(hidden) + " show no ground";
  }
  if (count(CarState::kStands) + count(CarState::kLeans) > 0) {
    words += ", " + std::to_string(count(CarState::kStands)) + " while the car stood, " +
             std::to_string(count(CarState::kLeans)) + " while it braked, sped up or turned";
  }
  return words;
}

}  // namespace

std::string words_of(const MountFit& fit, const UnitTurns& unit,
                     const description::SensorConfig& sensor) {
  std::string text =
      row("sensor", std::string(sensor.name) + ", " + std::string(lidar::name_of(sensor.format)) +
                        ", UDP port " + std::to_string(sensor.udp_port));
  text += row("turns", words_of_turns(fit, unit));
  if (!fit.refusal.empty()) {
    return text + row("NO MOUNT", fit.refusal);
  }
  const bool is_unknown = fit.turns[static_cast<std::size_t>(CarState::kUnknown)] == fit.taken;
  text +=
      row("driving", is_unknown ? "NOT KNOWN: the capture has no poses. Of a car that stands, all "
                                  "turns see the same place"
                                : "by the poses");
  text +=
      row("three parts", fixed(fit.apart_s, 1) + " s apart" +
                             (fit.apart_s < kPartsApartS ? ": LONGER IS SURER, 15 s or more" : ""));
  text += row("pitch_deg", words_of(fit.pitch_deg, sensor.mount.pitch_deg));
  text += row("roll_deg", words_of(fit.roll_deg, sensor.mount.roll_deg));
  if (!fit.has_roll()) {
    text += row("NO ROLL", "the parts differ by " + fixed(fit.roll_deg.difference(), 2) +
                               " degrees: the roll of the car's file stays");
  }
  text += words_of_sign("pitch_deg", fit.pitch_deg.value, sensor.mount.pitch_deg);
  text += words_of_sign("roll_deg", fit.roll_deg.value, sensor.mount.roll_deg);
  text += row("z_m", words_of(fit.z_m, sensor.mount.z_m));
  text += row("off the plane", fixed(1000 * fit.residual_m, 0) + " mm, standard deviation");
  return text;
}

std::string toml_of(const MountFit& fit, const description::MountConfig& by_file) {
  // More than a turn would be refused.
  const double roll_deg = std::abs(fit.roll_deg.value) > 360
                              ? std::remainder(fit.roll_deg.value, 360)
                              : fit.roll_deg.value;
  return "mount = { x_m = " + shortest(by_file.x_m) + ", y_m = " + shortest(by_file.y_m) +
         ", z_m = " + thousandths(fit.z_m.value) + ", yaw_deg = " + shortest(by_file.yaw_deg) +
         ", pitch_deg = " + thousandths(fit.pitch_deg.value) +
         ", roll_deg = " + (fit.has_roll() ? thousandths(roll_deg) : shortest(by_file.roll_deg)) +
         " }\n";
}

}  // namespace iog::tools
