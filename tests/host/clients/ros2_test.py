"""Does clients/ros2/iogrid_node.py make of a stream what docs/recordings.md says? ROS 2 is not here: stand-ins of its
messages have the fields of its definitions and no others, and a stand-in of rclpy keeps what is published."""

import importlib.util
import math
import sys
import types
import unittest

import streams
from object_parts import MOVES, YOUNG
from stream_test import received

import made_classes
import made_objects
import made_stream

# As visualization_msgs, nav_msgs, geometry_msgs, tf2_msgs and std_msgs of ROS 2 define them: a name is a type, anything
# else a value to begin with.
DEFINITIONS = {
    "Header": {"stamp": None, "frame_id": ""}, "Point": dict.fromkeys("xyz", 0.0), "Vector3": dict.fromkeys("xyz", 0.0),
    "Quaternion": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}, "Pose": {"position": "Point", "orientation": "Quaternion"},
    "Transform": {"translation": "Vector3", "rotation": "Quaternion"},
    "TransformStamped": {"header": "Header", "child_frame_id": "", "transform": "Transform"},
    "TFMessage": {"transforms": None}, "ColorRGBA": dict.fromkeys("rgba", 0.0),
    "MapMetaData": {"map_load_time": None, "resolution": 0.0, "width": 0, "height": 0, "origin": "Pose"},
    "OccupancyGrid": {"header": "Header", "info": "MapMetaData", "data": None}, "MarkerArray": {"markers": None},
    "Marker": {"header": "Header", "ns": "", "id": 0, "type": 0, "action": 0, "pose": "Pose", "scale": "Vector3",
               "color": "ColorRGBA", "lifetime": None, "frame_locked": False, "text": ""}}
CONSTANTS = {"Marker": {"CUBE": 1, "ADD": 0, "DELETEALL": 3}}
MODULES = {"nav_msgs": ["OccupancyGrid"], "geometry_msgs": ["TransformStamped"], "tf2_msgs": ["TFMessage"],
           "visualization_msgs": ["Marker", "MarkerArray"]}


def stand_in(name: str) -> type:
    fields = DEFINITIONS[name]

    def begin(self, **given):
        for field, first in fields.items():
            setattr(self, field, TYPES[first]() if first in TYPES else first)
        for field, value in given.items():
            setattr(self, field, value)

    return type(name, (), {"__slots__": tuple(fields), "__init__": begin, **CONSTANTS.get(name, {})})


TYPES: dict[str, type] = {}
TYPES.update({name: stand_in(name) for name in DEFINITIONS})


class Node:
    """Of rclpy; parameters are as the program has them."""

    published: list[tuple[str, object]] = []

    def __init__(self, name: str):
        assert name == "iogrid"

    def declare_parameter(self, _name: str, value):
        return types.SimpleNamespace(value=value)

    def create_publisher(self, kind: type, topic: str, _depth: int):
        def publish(message) -> None:
            assert isinstance(message, kind)
            self.published.append((topic, message))
        return types.SimpleNamespace(publish=publish)

    def get_clock(self):
        return types.SimpleNamespace(now=lambda: types.SimpleNamespace(to_msg=lambda: "now"))


def load_node():
    for package, names in MODULES.items():
        sys.modules[package] = types.ModuleType(package)
        sys.modules[package + ".msg"] = module = types.ModuleType(package + ".msg")
        for name in names:
            setattr(module, name, TYPES[name])
    sys.modules["rclpy"] = types.ModuleType("rclpy")
    sys.modules["rclpy"].init, sys.modules["rclpy"].ok = lambda: None, lambda: True
    sys.modules["rclpy.node"] = types.ModuleType("rclpy.node")
    sys.modules["rclpy.node"].Node = Node
    spec = importlib.util.spec_from_file_location("iogrid_node", streams.ROOT / "clients/ros2/iogrid_node.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def frames_of(*windows: made_classes.Window):
    target = made_stream.Target(0)
    messages = [message for window in windows for message in target.messages_of(made_stream.Grid(), 1, window)]
    return received(messages)[0]


class TheNode(unittest.TestCase):
    def published(self, *windows: made_classes.Window) -> dict[str, list]:
        node = load_node()
        Node.published = []
        node.iogrid = types.SimpleNamespace(**{**vars(node.iogrid), "listen": lambda *_: iter(
            [None, *frames_of(*windows), None])})
        node.main()
        found: dict[str, list] = {}
        for topic, message in Node.published:
            found.setdefault(topic, []).append(message)
        return found

    def test_classes_pose_and_boxes_are_those_of_the_stream(self):
        window = made_classes.Window(x_m=2.5, y_m=-1.25, turns=0.25, corner=(-15, -17))
        window.fill(range(-40, 60), range(-30, 30), made_classes.class_byte(made_classes.FREE))
        window.fill(range(0, 10), range(5, 6), made_classes.class_byte(made_classes.MOVING))
        things = [made_objects.Thing(7, MOVES, x_m=10.25, y_m=-2.5, turns=0.3, velocity=(-3.0, 9.0)),
                  made_objects.Thing(4_000_000_000, YOUNG, x_m=5, y_m=-60, length_m=0, is_hit=False)]
        window.objects = made_objects.objects_of(things)
        found = self.published(window)
        (grid,), (pose,), (marks,) = (found[topic] for topic in ("/classes", "/tf", "/objects/markers"))
        self.assertEqual((grid.header.stamp, grid.header.frame_id), ("now", "odom"))
        self.assertEqual((grid.info.width, grid.info.height, grid.info.resolution), (1024, 1024, 0.1))
        self.assertEqual((grid.info.origin.position.x, grid.info.origin.position.y), (-15 * 3.2, -17 * 3.2))
        self.assertEqual((grid.data.typecode, len(grid.data)), ("b", 1 << 20))
        self.assertEqual({value: grid.data.count(value) for value in set(grid.data)},
                         {-1: (1 << 20) - 6000, 5: 5990, 90: 10})
        self.assertEqual(grid.data[(17 * 32 + 5) * 1024 + 15 * 32 + 9], 90)
        (transform,) = pose.transforms
        self.assertEqual((transform.header.frame_id, transform.child_frame_id), ("odom", "base_link"))
        self.assertEqual((transform.transform.translation.x, transform.transform.translation.y), (2.5, -1.25))
        turn = transform.transform.rotation
        self.assertAlmostEqual(2 * math.atan2(turn.z, turn.w), math.tau / 4, 8)
        first, *boxes = marks.markers
        self.assertEqual(first.action, 3)
        self.assertEqual([box.id for box in boxes], [7, 4_000_000_000 - 2 ** 32])
        for box, thing in zip(boxes, things):
            self.assertEqual((box.type, box.action, box.header.frame_id), (1, 0, "odom"))
            self.assertEqual((box.pose.position.x, box.pose.position.y), (thing.x_m, thing.y_m))
            self.assertEqual((box.scale.x, box.scale.y), (max(thing.length_m, 0.1), thing.width_m))
            heading = 2 * math.atan2(box.pose.orientation.z, box.pose.orientation.w)
            self.assertAlmostEqual(math.remainder(heading - thing.turns * math.tau, math.tau), 0, 4)
        self.assertEqual([box.color.a for box in boxes], [0.6, 0.25])

    def test_what_is_not_known_is_not_published(self):
        self.assertEqual(set(self.published(made_classes.Window().without_pose())), {"/classes"})
        lost = made_classes.Window()
        lost.objects, lost.slices = [], 0
        self.assertNotIn("/objects/markers", self.published(lost))


if __name__ == "__main__":
    unittest.main()
