#!/usr/bin/env python3
"""What an iogrid target sends, as topics of ROS 2: /classes, /tf and /objects/markers, as in docs/recordings.md.

    PYTHONPATH=clients/python python3 clients/ros2/iogrid_node.py --ros-args -p port:=15000 -p address:=127.0.0.1

Its messages are tested against stand-ins for those of ROS 2; with ROS 2 itself nobody here has run it.
"""
import array
import math

import numpy
import rclpy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

import iogrid

PERCENT = numpy.array([-1, 0, 10, 5, 90, 85, 80, 100, 70], numpy.int8)  # by iogrid.Class
COLOUR = {iogrid.State.MOVES: (1.0, 0.16, 0.63), iogrid.State.STOPPED: (0.98, 0.75, 0.16),
          iogrid.State.STANDS: (0.84, 0.47, 0.16), iogrid.State.YOUNG: (0.94, 0.9, 0.47)}


def grid_of(frame: iogrid.Frame, stamp) -> OccupancyGrid:
    message = OccupancyGrid()
    message.header.stamp, message.header.frame_id = stamp, "odom"
    message.info.map_load_time, message.info.resolution = stamp, frame.window.geometry.cell_m
    message.info.height, message.info.width = frame.classes.shape
    message.info.origin.position.x, message.info.origin.position.y = (
        32 * frame.window.geometry.cell_m * corner for corner in frame.window.corner)
    message.data = array.array("b", PERCENT[frame.classes].tobytes())
    return message


def transform_of(pose: iogrid.Pose, stamp) -> TFMessage:
    transform = TransformStamped()
    transform.header.stamp, transform.header.frame_id, transform.child_frame_id = stamp, "odom", "base_link"
    transform.transform.translation.x, transform.transform.translation.y = pose.x_m, pose.y_m
    turn = transform.transform.rotation
    turn.z, turn.w = math.sin(pose.heading_rad / 2), math.cos(pose.heading_rad / 2)
    return TFMessage(transforms=[transform])


def marker_of(thing: iogrid.Object, stamp) -> Marker:
    heading = (thing.heading_rad or 0.0) / 2
    marker = Marker(ns="box", id=thing.id - (thing.id >> 31 << 32), type=Marker.CUBE, action=Marker.ADD)
    marker.header.stamp, marker.header.frame_id = stamp, "odom"
    marker.pose.position.x, marker.pose.position.y, marker.pose.position.z = thing.x_m, thing.y_m, 0.75
    marker.pose.orientation.z, marker.pose.orientation.w = math.sin(heading), math.cos(heading)
    marker.scale.x, marker.scale.y, marker.scale.z = max(thing.length_m, 0.1), max(thing.width_m, 0.1), 1.5
    marker.color.r, marker.color.g, marker.color.b = COLOUR[thing.state]
    marker.color.a = 0.6 if thing.is_hit else 0.25
    return marker


def main() -> None:
    rclpy.init()
    node = Node("iogrid")
    port, address = (node.declare_parameter(*each).value for each in (("port", 15000), ("address", "127.0.0.1")))
    grids = node.create_publisher(OccupancyGrid, "/classes", 1)
    poses = node.create_publisher(TFMessage, "/tf", 10)
    markers = node.create_publisher(MarkerArray, "/objects/markers", 1)
    for frame in iogrid.listen(port, address):
        if not rclpy.ok():
            break
        stamp = node.get_clock().now().to_msg()
        if frame is not None and frame.window is not None:
            if frame.window.pose is not None:
                poses.publish(transform_of(frame.window.pose, stamp))
            grids.publish(grid_of(frame, stamp))
        if frame is not None and frame.objects is not None:
            markers.publish(MarkerArray(markers=[Marker(action=Marker.DELETEALL)] +
                                        [marker_of(thing, stamp) for thing in frame.objects]))


if __name__ == "__main__":
    main()
