#!/usr/bin/env python3
"""Sends PointCloud2 and LaserScan topics of ROS 2 to an iogrid target, for a car with a sensor of type points.

    PYTHONPATH=clients/python python3 clients/ros2/points_node.py --ros-args -p address:=10.0.2.15 -p port:=2368 \\
        -r cloud:=/velodyne_points -r scan:=/scan -p turns:=true

field_of_view_deg is the car file's scan_width_ticks / 32. The encoding is tested against `iog points`; with ROS 2 itself
nobody here has run it.
"""
import socket
import sys
import time

import numpy
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan, PointCloud2

from iogrid import points

TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}  # sensor_msgs/PointField
PAUSE_S = 0.0002  # between datagrams, so that a whole cloud does not overrun the target at once


def stamp_us(message) -> int:
    return message.header.stamp.sec * 1_000_000 + message.header.stamp.nanosec // 1000


def scan_of_cloud(message, unit_us: float | None) -> tuple[points.Scan, float | None]:
    """And the unit of the points' times, if it is known from now on. Without a unit, points are sent without times."""
    order = ">" if message.is_bigendian else "<"
    fields = [field for field in message.fields if field.name]
    kind = numpy.dtype({"names": [field.name for field in fields], "itemsize": message.point_step,
                        "formats": [order + TYPES[field.datatype] for field in fields],
                        "offsets": [field.offset for field in fields]})
    cloud = numpy.frombuffer(bytes(message.data), kind, message.width * message.height)
    begin_us = its_us = stamp_us(message)
    after_us = None
    name = next((name for name in points.TIME_FIELDS if name in kind.names), None)
    unit_us = unit_us or (points.unit_us_of(cloud[name]) if name else None)
    if name and unit_us and len(cloud) and numpy.ptp(cloud[name]) != 0:
        first_us, after_us = points.after_us_of(cloud[name], unit_us)
        its_us = int(begin_us + first_us if first_us < 1e12 else first_us)
        its_us = its_us if abs(its_us - begin_us) <= 1_000_000 else begin_us
    z = cloud["z"] if "z" in kind.names else numpy.zeros(len(cloud))
    return points.of_places(cloud["x"], cloud["y"], z, its_us, after_us), unit_us


def scan_of_laser(message) -> points.Scan:
    points.check_laser(len(message.ranges), message.angle_min, message.angle_max, message.angle_increment,
                       message.range_min, message.range_max)
    return points.of_ranges(message.ranges, message.angle_min, message.angle_increment, stamp_us(message),
                            message.time_increment, message.range_min, message.range_max)


class PointsNode(Node):
    def __init__(self):
        super().__init__("iogrid_points")
        self.target = tuple(self.declare_parameter(*each).value for each in (("address", "10.0.2.15"), ("port", 2368)))
        self.view_deg = self.declare_parameter("field_of_view_deg", 360.0).value
        self.turns = self.declare_parameter("turns", False).value
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.number = 0
        self.unit_us = None
        self.create_subscription(PointCloud2, "cloud", self.send_cloud, qos_profile_sensor_data)
        self.create_subscription(LaserScan, "scan", lambda message: self.send(scan_of_laser(message)),
                                 qos_profile_sensor_data)

    def send_cloud(self, message) -> None:
        scan, self.unit_us = scan_of_cloud(message, self.unit_us)
        self.send(scan)

    def send(self, scan: points.Scan) -> None:
        for datagram in points.datagrams(scan, self.number, self.view_deg, self.turns):
            self.socket.sendto(datagram, self.target)
            time.sleep(PAUSE_S)
        self.number += 1


def main() -> None:
    rclpy.init()
    try:
        rclpy.spin(PointsNode())
    except ValueError as wrong:
        sys.exit(f"points_node: {wrong}")


if __name__ == "__main__":
    main()
