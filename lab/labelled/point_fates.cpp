// The fate of each point of a folder of clouds, as the target judges it, for lab/labelled/score, or
// the ground of a capture, for lab/recorded/labelled_capture.py.
//
//   point_fates FOLDER|CAPTURE CAR.toml OUT
//
// The folder has KITTI's odometry form, as SemanticKITTI does (docs/drives.md), and the car one
// Velodyne, which follows the ground. For each cloud a letter a point, in the order of its file:
// (g)round, (o)bstacle, over(h)ang, (u)nder the ground, '-' for another fate, '.' for what no
// packet holds; clouds one after the other. For each return of a capture's first sensor that is
// ground: when its packet came (us since 1970) and its place in the vehicle frame (x, y, z in mm),
// four int64, little endian.
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "intake/packet.hpp"
#include "lab/experiments/hills/fate_watch.hpp"
#include "tools/clouds/cloud_conversion.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/vehicles/point_place.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "wire/byte_order.hpp"

namespace iog::lab {
namespace {

using tools::UsageError;

constexpr char kNotSent = '.';

char letter_of(vehicle::Fate fate) {
  using vehicle::Fate;
  switch (fate) {
    case Fate::kUsed:
      return 'o';
    case Fate::kGround:
      return 'g';
    case Fate::kOverhang:
      return 'h';
    case Fate::kUnderGround:
      return 'u';
    default:
      return '-';
  }
}

std::size_t velodyne_of(const tools::CatalogueEntry& car) {
  for (std::size_t sensor = 0; sensor < car.sensors.size(); ++sensor) {
    if (tools::velodyne_unit_of(car.sensors[sensor].format) != nullptr) {
      if (!car.vehicle->sensors[sensor].ground.is_followed()) {
        throw UsageError(std::string(car.sensors[sensor].name) +
                         " does not follow the ground: give it `ground`");
      }
      return sensor;
    }
  }
  throw UsageError(std::string(car.vehicle->name) + " has no Velodyne");
}

// Of each turn the fates of its points.
using Fates = std::map<std::size_t, std::string>;

Fates unsent(const tools::CloudSet& set) {
  Fates fates;
  for (std::size_t i = 0; i < set.clouds.size(); ++i) {
    if (set.clouds[i].empty()) {
      continue;
    }
    const tools::PointCloud cloud = tools::read_cloud(set.clouds[i]);
    if (cloud.not_finite != 0) {
      throw UsageError(set.clouds[i] + ": has points that are no number");
    }
    fates[set.forward[i].turn].assign(cloud.points.size(), kNotSent);
  }
  return fates;
}

Fates judged(const std::string& folder, const tools::CatalogueEntry& car) {
  tools::CloudConversion conversion(folder, car, velodyne_of(car), 0, 0);
  Fates fates = unsent(conversion.set());
  std::multimap<std::uint64_t, tools::SentPoint> sent;  // by datagram
  conversion.tell([&](const tools::SentPoint& point) { sent.emplace(point.datagram_us, point); });
  FateWatch watch(*car.vehicle);
  for (std::vector<tools::CapturedDatagram> next; !(next = conversion.next()).empty();) {
    for (const tools::CapturedDatagram& datagram : next) {
      const std::vector<vehicle::Fate>& its = watch.take(datagram);
      if (its.empty()) {
        continue;  // a pose
      }
      const auto [begin, end] = sent.equal_range(datagram.time_us);
      for (auto point = begin; point != end; ++point) {
        fates[point->second.turn][point->second.point] = letter_of(its.at(point->second.range));
      }
      sent.erase(begin, end);
    }
  }
  return fates;
}

void write_ground(const std::string& path, const tools::CatalogueEntry& car,
                  tools::OutputFile& out) {
  tools::PcapReader capture(path);
  FateWatch watch(*car.vehicle);
  const vehicle::Sensor& sensor = car.vehicle->sensors[0];
  const tools::PointPlacer placer(car.sensors[0]);
  while (const std::optional<tools::CapturedDatagram> datagram = capture.next()) {
    const std::vector<vehicle::Fate>& fates = watch.take(*datagram);
    if (fates.empty() || datagram->destination.port != sensor.udp_port) {
      continue;
    }
    std::size_t number = 0;
    intake::Packet::decode(sensor.format, datagram->payload, sensor.unit())
        .for_each_point([&](const lidar::ScanPoint& point) {
          if (fates.at(number++) != vehicle::Fate::kGround) {
            return;
          }
          const tools::PointPlace place = placer.place(point);
          const auto mm = [](double metres) { return std::llround(metres * 1000); };
          std::array<std::byte, 32> bytes{};
          const std::array words = {static_cast<long long>(datagram->time_us), mm(place.x_m),
                                    mm(place.y_m), mm(place.z_m)};
          for (std::size_t i = 0; i < words.size(); ++i) {
            wire::store_le64(std::span(bytes).subspan(8 * i).first<8>(),
                             static_cast<std::uint64_t>(words[i]));
          }
          out.write(bytes);
        });
  }
}

void run(const std::string& folder, const std::string& car_path, const std::string& out_path) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::add_vehicle_file(car_path));
  tools::OutputFile out(out_path);
  if (!std::filesystem::is_directory(folder)) {
    write_ground(folder, car, out);
    out.finish();
    return;
  }
  for (const auto& [turn, fates] : judged(folder, car)) {
    out.write(std::string_view(fates));
  }
  out.finish();
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "point_fates: expected a folder or capture, a car's file and a file to write\n";
    return iog::tools::kWrongUse;
  }
  try {
    iog::lab::run(argv[1], argv[2], argv[3]);
  } catch (const iog::tools::UsageError& error) {
    std::cerr << "point_fates: " << error.what() << '\n';
    return iog::tools::kWrongUse;
  }
  return iog::tools::kDone;
}
