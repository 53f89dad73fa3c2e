#include "pose/wire_format.hpp"

namespace iog::pose {

void write(const Pose& pose, wire::ByteWriter& out) {
  out.i32_be(pose.x_mm);
  out.i32_be(pose.y_mm);
  out.u32_be(pose.heading);
}

void write(const Sigma& sigma, wire::ByteWriter& out) {
  out.u16_be(sigma.position_mm);
  out.u16_be(sigma.heading_10urad);
}

void write(const std::optional<MapTransform>& map, wire::ByteWriter& out) {
  const MapTransform transform = map.value_or(kNoMap);
  out.u64_be(transform.origin);
  write(transform.local_frame, out);
  write(transform.sigma, out);
}

Pose read_pose(wire::ByteReader& in) {
  Pose pose;
  pose.x_mm = in.i32_be();
  pose.y_mm = in.i32_be();
  pose.heading = in.u32_be();
  return pose;
}

Sigma read_sigma(wire::ByteReader& in) {
  Sigma sigma;
  sigma.position_mm = in.u16_be();
  sigma.heading_10urad = in.u16_be();
  return sigma;
}

MapTransform read_map_transform(wire::ByteReader& in) {
  MapTransform map;
  map.origin = in.u64_be();
  map.local_frame = read_pose(in);
  map.sigma = read_sigma(in);
  return map;
}

}  // namespace iog::pose
