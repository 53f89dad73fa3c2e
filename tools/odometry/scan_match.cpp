#include "tools/odometry/scan_match.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace iog::tools {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kMostRounds = 30;
constexpr double kSettledM = 2e-4;
constexpr double kLeastKernelM = 0.1;
constexpr double kRangeNoiseM = 0.03;

struct Sums {
  Matrix6 information = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  Eigen::Matrix2d facing = Eigen::Matrix2d::Zero();
  double weight = 0;
  double squares = 0;
  double agreeing = 0;
};

// Geman and McClure's weight, so that moving objects do not pull.
double robust_weight(double residual_m, double kernel_m) {
  const double share = kernel_m * kernel_m / (kernel_m * kernel_m + residual_m * residual_m);
  return share * share;
}

Sums sums_at(std::span<const Eigen::Vector3d> points, const LocalMap& map, const Pose& pose,
             double most_m) {
  const double kernel_m = std::max(kLeastKernelM, most_m / 3);
  Sums sums;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d place = pose * point;
    const auto plane = map.plane_at(place, std::min(most_m, kVoxelM));
    if (!plane) {
      continue;
    }
    const double residual_m = plane->normal.dot(place) - plane->offset_m;
    const double weight = robust_weight(residual_m, kernel_m) * plane->flatness * plane->flatness;
    Vector6 row;
    row << plane->normal, (place - pose.translation()).cross(plane->normal);
    sums.information += weight * row * row.transpose();
    sums.gradient += weight * residual_m * row;
    sums.facing += weight * plane->normal.head<2>() * plane->normal.head<2>().transpose();
    sums.weight += weight;
    sums.squares += weight * residual_m * residual_m;
    sums.agreeing += robust_weight(residual_m, kLeastKernelM);
  }
  return sums;
}

Eigen::Vector3d turn_between(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  return turn.angle() * turn.axis();
}

void hold_by_prediction(Sums& sums, const Pose& pose, const Pose& predicted, const Doubt& doubt) {
  const double move = std::pow(kRangeNoiseM / doubt.sigma_m, 2);
  const double turn = std::pow(kRangeNoiseM / doubt.sigma_rad, 2);
  sums.information.diagonal().head<3>().array() += move;
  sums.information.diagonal().tail<3>().array() += turn;
  sums.gradient.head<3>() += move * (pose.translation() - predicted.translation());
  sums.gradient.tail<3>() += turn * turn_between(predicted, pose);
}

void step(Pose& pose, const Vector6& by) {
  pose.translation() += by.head<3>();
  const double angle = by.tail<3>().norm();
  if (angle > 0) {
    pose.linear() =
        Eigen::AngleAxisd(angle, by.tail<3>() / angle).toRotationMatrix() * pose.linear();
  }
}

}  // namespace

ScanMatch match_scan(std::span<const Eigen::Vector3d> points, const LocalMap& map,
                     const Pose& predicted, const Doubt& doubt) {
  ScanMatch match{.pose = predicted};
  for (int round = 0; round < kMostRounds; ++round) {
    Sums sums = sums_at(points, map, match.pose, doubt.most_m);
    if (sums.weight <= 0) {
      return {.pose = predicted};
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> facing;
    facing.computeDirect(sums.facing / sums.weight);
    match.least_support = facing.eigenvalues()[0];
    match.agreement = sums.agreeing / static_cast<double>(points.size());
    match.residual_m = std::sqrt(sums.squares / sums.weight);
    hold_by_prediction(sums, match.pose, predicted, doubt);
    const Vector6 by = -sums.information.ldlt().solve(sums.gradient);
    step(match.pose, by);
    if (by.head<3>().norm() + 10 * by.tail<3>().norm() < kSettledM) {
      break;
    }
  }
  return match;
}

}  // namespace iog::tools
