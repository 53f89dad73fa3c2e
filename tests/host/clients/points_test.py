"""Does clients/ros2/points_node.py send what `iog points` makes of the same messages? ROS 2 is not here: stand-ins of its
messages have the fields of its definitions, and one of rclpy keeps who subscribes."""

import importlib.util
import socket
import sys
import types
import unittest

import streams

import capture
import made_bags
import numpy

CAR = """name = "it"
footprint = { x_min_m = -0.3, x_max_m = 0.3, y_min_m = -0.2, y_max_m = 0.2 }
[[sensors]]
name = "front"
mount = { x_m = 0, y_m = 0, z_m = 0.2 }
range_max_mm = 30_000
layers = { from_deg = -20, to_deg = 20, count = 16 }
max_points_per_scan = 4_000
"""
KINDS = {"turning": 'type = "points_turning"\n', "wide": 'type = "points"\nscan_width_ticks = 8640\n',  # 270 degrees
         "narrow": 'type = "points"\nscan_width_ticks = 2240\n'}  # 70 degrees


class Node:
    """Of rclpy; PARAMETERS are what somebody gave by -p."""

    PARAMETERS: dict[str, object] = {}
    subscriptions: dict[str, object] = {}
    qualities: list[dict] = []
    warnings: list[str] = []

    def __init__(self, name: str):
        assert name == "iogrid_points"

    def declare_parameter(self, name: str, value):
        return types.SimpleNamespace(value=self.PARAMETERS.get(name, value))

    def create_subscription(self, kind: str, topic: str, take, quality) -> None:
        self.subscriptions[topic] = take
        self.qualities.append(quality)

    def get_logger(self):
        return types.SimpleNamespace(warning=self.warnings.append)


def load_node():
    Node.qualities.clear()
    Node.warnings.clear()
    for name, content in {"rclpy": {"init": lambda: None}, "rclpy.node": {"Node": Node},
                          "rclpy.executors": {"ExternalShutdownException": Exception},
                          "rclpy.qos": {"QoSProfile": dict, "ReliabilityPolicy": types.SimpleNamespace(BEST_EFFORT="best")},
                          "sensor_msgs": {},
                          "sensor_msgs.msg": {"PointCloud2": "PointCloud2", "LaserScan": "LaserScan"}}.items():
        sys.modules[name] = types.ModuleType(name)
        vars(sys.modules[name]).update(content)
    spec = importlib.util.spec_from_file_location("points_node", streams.ROOT / "clients/ros2/points_node.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def header(time_ns: int):
    return types.SimpleNamespace(stamp=types.SimpleNamespace(sec=time_ns // 10**9, nanosec=time_ns % 10**9), frame_id="it")


def cloud_message(time_ns: int, points: numpy.ndarray, is_bigendian: bool = False):
    fields = [types.SimpleNamespace(name=name, offset=points.dtype.fields[name][1], datatype=made_bags.FORMATS[name], count=1)
              for name in points.dtype.names]
    data = (points.byteswap() if is_bigendian else points).tobytes()
    return types.SimpleNamespace(header=header(time_ns), height=1, width=len(points), fields=fields, data=data,
                                 is_bigendian=is_bigendian, point_step=points.itemsize, row_step=len(data), is_dense=False)


def scan_message(time_ns: int, ranges: numpy.ndarray, first: float, step: float, apart_s: float):
    first, step, apart_s = (float(numpy.float32(each)) for each in (first, step, apart_s))
    return types.SimpleNamespace(header=header(time_ns), angle_min=first, angle_max=first + step * (len(ranges) - 1),
                                 angle_increment=step, time_increment=apart_s, scan_time=0.1, ranges=ranges.tolist(),
                                 range_min=float(numpy.float32(0.1)), range_max=20.0, intensities=[])


def clouds(*names: str) -> list[numpy.ndarray]:
    """Two, with points of no number and at the sensor."""
    noise = numpy.random.default_rng(3)
    kinds = {"x": "<f4", "y": "<f4", "z": "<f4", "ring": "<u2", "time": "<f4"}
    made = []
    for _ in range(2):
        cloud = numpy.zeros(1000, [(name, kinds[name]) for name in names])
        for name in names:
            cloud[name] = noise.uniform(-10, 10, 1000)
        cloud["x"][[3, 7]] = numpy.nan, numpy.inf
        for name in ("x", "y", "z"):
            cloud[name][11] = 0
        if "time" in names:
            cloud["time"] = noise.permutation(1000) / 16384 - 0.05  # behind its last point, as Velodyne's driver has it
        made.append(cloud)
    return made


class PointsNode(unittest.TestCase):
    def sent(self, car: str, topic: str, rows: list[made_bags.Row], messages: list, **parameters) -> None:
        """The node's datagrams are those of `iog points`."""
        streams.FOLDER.mkdir(parents=True, exist_ok=True)
        bag, file, out = (streams.FOLDER / name for name in ("it.db3", "it.toml", "it.pcap"))
        file.write_text(CAR + KINDS[car])
        made_bags.write_sqlite(bag, rows)
        streams.iog("points", bag, "--vehicle-file", file, "--out", out)
        expected = [packet.payload for packet in capture.read(out)]
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as target:
            target.bind(("127.0.0.1", 0))
            target.settimeout(10)
            Node.PARAMETERS = {"address": "127.0.0.1", "port": target.getsockname()[1], **parameters}
            node = load_node().PointsNode()
            for message in messages:
                Node.subscriptions[topic](message)
                node.send_next()
            node.socket.close()
            self.assertEqual([target.recv(2000) for _ in expected], expected)

    def test_clouds(self):
        times = [made_bags.START_NS, made_bags.START_NS + 100_000_000]
        for names in (("x", "y", "z", "ring", "time"), ("x", "y", "z")):
            for is_big_endian in (False, True):
                its = list(zip(times, clouds(*names)))
                for kind, parameters in (("turning", {"turns": True}), ("wide", {"field_of_view_deg": 270.0}),
                                         ("narrow", {"field_of_view_deg": 70.0})):
                    self.sent(kind, "cloud",
                              [("/it", now, made_bags.point_cloud2(now, cloud, is_big_endian)) for now, cloud in its],
                              [cloud_message(now, cloud, is_big_endian) for now, cloud in its], **parameters)

    def test_points_outside_the_field_of_view(self):
        """They are counted, and none of them has its datagram dropped; the rest is sent."""
        points = load_node().points
        azimuth = numpy.array([0, 35 * 3200, 35 * 3200 + 1, 180 * 3200, 325 * 3200 - 1, 325 * 3200])
        scan = points.Scan(0, azimuth, numpy.zeros(6, int), numpy.arange(1, 7), numpy.arange(6), numpy.arange(6))
        self.assertEqual(points.is_outside(scan, 70).tolist(), [False, False, True, True, True, False])
        self.assertFalse(points.is_outside(scan, 70, turns=True).any())
        (datagram,) = points.datagrams(scan, 0, 70)
        sent = numpy.frombuffer(datagram[32:], points.POINT)
        self.assertEqual(sent["range"].tolist(), [1, 2, 6])
        self.assertEqual(sent["flags"].tolist(), [0, 1, 5])

    def parts_of_clouds(self, *sizes: tuple[int, int]) -> list[numpy.ndarray]:
        """Of so many points, and from the first to the last so many nanoseconds."""
        clouds = []
        for count, span in sizes:
            cloud = numpy.zeros(count, [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("t", "<u4")])
            cloud["x"], cloud["t"] = 5, numpy.linspace(0, span, count)
            clouds.append(cloud)
        return clouds

    def test_a_part_of_a_cloud_keeps_the_unit(self):
        """20 us in nanoseconds would be 20 ms in microseconds."""
        clouds = self.parts_of_clouds((1000, 10**8), (10, 20_000), (20, 1_900_000))
        its = [(made_bags.START_NS + i * 10**8, cloud) for i, cloud in enumerate(clouds)]
        self.sent("turning", "cloud", [("/it", now, made_bags.point_cloud2(now, cloud)) for now, cloud in its],
                  [cloud_message(now, cloud) for now, cloud in its], turns=True)

    def test_before_the_first_full_cloud_no_unit_is_known(self):
        """`iog points` looks ahead; the node cannot."""
        node, unit_us = load_node(), None
        scans = []
        for cloud in self.parts_of_clouds((10, 20_000), (1000, 10**8), (10, 20_000)):
            scan, unit_us = node.scan_of_cloud(cloud_message(made_bags.START_NS, cloud), unit_us)
            scans.append(scan)
        self.assertIsNone(scans[0].after_us)
        self.assertEqual([scan.after_us[-1] for scan in scans[1:]], [100_000, 20])

    def test_a_scan_whose_head_contradicts_itself(self):
        node = load_node().PointsNode()
        good = scan_message(made_bags.START_NS, numpy.full(5, 5.0), -0.2, 0.1, 0.001)
        Node.subscriptions["scan"](good)
        node.send_next()
        for name, value in (("range_max", 0.0), ("range_max", numpy.nan), ("range_min", 30.0), ("angle_min", numpy.nan),
                            ("angle_increment", 0.0), ("angle_increment", -0.3), ("angle_increment", 0.05)):
            with self.assertRaisesRegex(ValueError, f"{name}.* {value:g}" if value != 0.05 else "angle_max is 0.2"):
                Node.subscriptions["scan"](types.SimpleNamespace(**{**vars(good), name: value}))
                node.send_next()
        node.socket.close()

    def node_without_target(self):
        """Its datagrams and pauses come into lists; its clock goes on by pauses alone."""
        module, sent, pauses = load_node(), [], []
        module.time = types.SimpleNamespace(monotonic=lambda: 1000 + sum(pauses), sleep=pauses.append)
        node = module.PointsNode()
        node.socket.close()
        node.socket = types.SimpleNamespace(sendto=lambda datagram, _target: sent.append(datagram))
        return node, sent, pauses

    def test_a_message_is_sent_before_the_next_one_comes(self):
        """131,072 points in 100 ms, as of an Ouster of 128 layers, need 1,543 datagrams."""
        node, sent, pauses = self.node_without_target()
        node.send([b"it"] * 1543)
        self.assertEqual(len(sent), 1543)
        self.assertEqual(len(pauses), 96)
        self.assertAlmostEqual(sum(pauses), 0.05, 3)
        pauses.clear()
        node.send([b"it"] * 13)  # of a 2D scanner
        self.assertEqual(pauses, [])
        node.send([b"it"] * 353)  # 30,000 points
        self.assertAlmostEqual(max(pauses), 0.05 * 16 / 353)
        pauses.clear()
        node.send([b"it"] * 64)
        self.assertAlmostEqual(max(pauses), 0.003)

    def test_a_fast_scanner_has_shorter_pauses(self):
        node, _, pauses = self.node_without_target()
        for time_ms in (0, 25, 50, 40, 41, 60):  # those that do not rise by 10 ms say nothing
            Node.subscriptions["scan"](scan_message(made_bags.START_NS + time_ms * 10**6, numpy.full(5, 5.0), -0.2, 0.1, 0))
        self.assertAlmostEqual(node.period_s, 0.019)
        node.send([b"it"] * 640)
        self.assertAlmostEqual(sum(pauses), 0.019 / 2 * 39 / 40)

    def test_only_the_newest_message_waits(self):
        """In the middleware, too; whoever does not keep up is told."""
        node, sent, _ = self.node_without_target()
        self.assertEqual(Node.qualities, [{"depth": 1, "reliability": "best"}] * 2)
        for number in range(4):
            Node.subscriptions["scan"](scan_message(made_bags.START_NS + number * 10**8, numpy.full(5, 5.0), -0.2, 0.1, 0))
            if number == 0:
                node.send_next()
        node.send_next()
        node.send_next(0)
        self.assertEqual([int.from_bytes(datagram[16:24], "little") - made_bags.START_NS // 1000 for datagram in sent],
                         [0, 300_000])
        self.assertEqual(node.skipped, 2)
        self.assertEqual(Node.warnings, ["so far, 2 messages were skipped: they come faster than they are sent"])

    def test_points_outside_are_told(self):
        node, sent, _ = self.node_without_target()
        node.view_deg = 70.0
        cloud = numpy.zeros(10, [("x", "<f4"), ("y", "<f4"), ("z", "<f4")])
        cloud["x"][:7], cloud["y"][7:] = 5, 5
        for _ in range(3):
            Node.subscriptions["cloud"](cloud_message(made_bags.START_NS, cloud))
            node.send_next()
        self.assertEqual([len(datagram) for datagram in sent], [32 + 7 * 16] * 3)
        self.assertEqual(Node.warnings, ["so far, 3 points outside field_of_view_deg were not sent",
                                         "so far, 6 points outside field_of_view_deg were not sent"])

    def test_scans(self):
        ranges = numpy.float32(numpy.random.default_rng(4).uniform(0.05, 21, 1081))
        ranges[[5, 9, 11]] = numpy.inf, numpy.nan, 0
        for scan_s, side in ((0.075, 1), (0.075, -1), (0.0, 1)):  # counter-clockwise and clockwise
            first, step, now = side * -2.356, side * 4.712 / 1080, made_bags.START_NS
            self.sent("wide", "scan", [("/it", now, made_bags.laser_scan(now, ranges, first, step, scan_s))],
                      [scan_message(now, ranges, first, step, scan_s / 1081)], field_of_view_deg=270.0)


if __name__ == "__main__":
    unittest.main()
