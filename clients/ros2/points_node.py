#!/usr/bin/env python3
"""Sends PointCloud2 and LaserScan topics of ROS 2 to an iogrid target, for a car with a sensor of type points.

    PYTHONPATH=clients/python python3 clients/ros2/points_node.py --ros-args -p address:=10.0.2.15 -p port:=2368 \\
        -r cloud:=/velodyne_points -r scan:=/scan -p turns:=true

field_of_view_deg is the car file's scan_width_ticks / 32; points outside it are not sent. Only the newest message waits while
one is sent. The encoding is tested against `iog points`; with ROS 2 itself nobody here has run it.
"""
import socket
import sys
import threading
import time

import numpy
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan, PointCloud2

from iogrid import points

TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}  # sensor_msgs/PointField
BURST = 16  # datagrams at once, so that a whole cloud does not overrun the target
PAUSE_S = 0.003  # from burst to burst, or less, so that a message takes at most this share of the time to the next one:
SHARE = 0.5


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
        self.arrival = threading.Condition()
        self.waiting = None  # the newest message that is not sent
        self.newest_us = 0
        self.period_s = 0.1  # the shortest time between two messages' stamps
        self.skipped = self.outside = 0  # messages that a newer one replaced, and points
        self.told = {}  # of each warning, its last number
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.create_subscription(PointCloud2, "cloud", self.take, newest)
        self.create_subscription(LaserScan, "scan", self.take, newest)

    def take(self, message) -> None:
        with self.arrival:
            self.skipped += self.waiting is not None
            self.waiting = message
            apart_us, self.newest_us = stamp_us(message) - self.newest_us, stamp_us(message)
            self.period_s = min(self.period_s, apart_us / 1e6) if apart_us >= 10_000 else self.period_s
            self.arrival.notify()

    def send_next(self, timeout_s: float = 0.5) -> None:
        """Sends the message that waits or comes in this time."""
        with self.arrival:
            self.arrival.wait_for(lambda: self.waiting is not None, timeout_s)
            message, self.waiting, skipped = self.waiting, None, self.skipped
        if message is None:
            return
        if hasattr(message, "ranges"):
            scan = scan_of_laser(message)
        else:
            scan, self.unit_us = scan_of_cloud(message, self.unit_us)
        self.outside += int(points.is_outside(scan, self.view_deg, self.turns).sum())
        self.tell(skipped, "messages were skipped: they come faster than they are sent")
        self.tell(self.outside, "points outside field_of_view_deg were not sent")
        self.send(points.datagrams(scan, self.number, self.view_deg, self.turns))
        self.number += 1

    def tell(self, count: int, words: str) -> None:
        """When there is a first one, and whenever there are twice as many."""
        if count >= 2 * self.told.get(words, 0) and count:
            self.told[words] = count
            self.get_logger().warning(f"so far, {count} {words}")

    def send(self, datagrams: list[bytes]) -> None:
        pause_s = min(PAUSE_S, SHARE * self.period_s * BURST / len(datagrams))
        next_s = time.monotonic()
        for i, datagram in enumerate(datagrams):
            if i and i % BURST == 0:
                next_s += pause_s
                time.sleep(max(next_s - time.monotonic(), 0))
            self.socket.sendto(datagram, self.target)


def take_messages(node: PointsNode) -> None:
    try:
        rclpy.spin(node)
    except ExternalShutdownException:
        pass


def main() -> None:
    rclpy.init()
    node = PointsNode()
    threading.Thread(target=take_messages, args=[node], daemon=True).start()
    try:
        while rclpy.ok():
            node.send_next()
    except KeyboardInterrupt:
        pass
    except ValueError as wrong:
        sys.exit(f"points_node: {wrong}")


if __name__ == "__main__":
    main()
