"""Recordings of ROS 2 as rosbag2 writes them, put together from its documentation: messages in CDR (OMG DDSI-RTPS 2.2,
10.2), files of its storages sqlite3 and mcap (https://mcap.dev/spec), the folder of a bag."""

import math
import pathlib
import sqlite3
import struct
import subprocess

import numpy

START_NS = 1_700_000_000_000_000_000
FORMATS = {"x": 7, "y": 7, "z": 7, "ring": 4, "time": 7, "timestamp": 8, "t": 6}  # sensor_msgs/PointField


class Cdr:
    """A number lies on a multiple of its size, counted from behind the four bytes of the encapsulation."""

    def __init__(self):
        self.bytes = b""

    def put(self, kind: str, *values):
        for value in values:
            self.bytes += bytes(-len(self.bytes) % struct.calcsize(kind)) + struct.pack("<" + kind, value)
        return self

    def text(self, words: str):
        self.put("I", len(words) + 1)
        self.bytes += words.encode() + b"\0"
        return self

    def raw(self, data: bytes, count: int | None = None):
        self.put("I", len(data) if count is None else count)
        self.bytes += data
        return self

    def header(self, time_ns: int, frame: str):
        return self.put("I", time_ns // 10**9, time_ns % 10**9).text(frame)

    def message(self) -> bytes:
        return b"\0\1\0\0" + self.bytes


def point_cloud2(time_ns: int, points: numpy.ndarray, is_big_endian: bool = False,
                 frame: str = "lidar") -> tuple[str, bytes]:
    """Of a structured array, row by row."""
    out = Cdr().header(time_ns, frame).put("I", 1, len(points), len(points.dtype.names))
    for name in points.dtype.names:
        out.text(name).put("I", points.dtype.fields[name][1]).put("B", FORMATS[name]).put("I", 1)
    data = (points.byteswap() if is_big_endian else points).tobytes()
    out.put("B", is_big_endian).put("I", points.itemsize, len(data)).raw(data).put("B", 1)
    return "sensor_msgs/msg/PointCloud2", out.message()


def laser_scan(time_ns: int, ranges: numpy.ndarray, first: float, step: float, scan_s: float) -> tuple[str, bytes]:
    out = Cdr().header(time_ns, "laser").put("f", first, first + step * (len(ranges) - 1), step)
    out.put("f", scan_s / len(ranges), scan_s, 0.1, 20.0).raw(ranges.astype("<f4").tobytes(), len(ranges)).put("I", 0)
    return "sensor_msgs/msg/LaserScan", out.message()


def odometry(time_ns: int, x_m: float, y_m: float, heading: float, speed: float,
             child: str = "base_link") -> tuple[str, bytes]:
    out = Cdr().header(time_ns, "odom").text(child)
    out.put("d", x_m, y_m, 0, 0, 0, math.sin(heading / 2), math.cos(heading / 2), *[0] * 36, speed, *[0] * 5, *[0] * 36)
    return "nav_msgs/msg/Odometry", out.message()


def transforms(*edges: tuple[str, str, tuple]) -> tuple[str, bytes]:
    """Parent, child, and the child's x, y, z and quaternion in it."""
    out = Cdr().put("I", len(edges))
    for parent, child, place in edges:
        out.header(START_NS, parent).text(child).put("d", *place)
    return "tf2_msgs/msg/TFMessage", out.message()


def varint(value: int) -> bytes:
    return bytes([value]) if value < 128 else bytes([value & 127 | 128]) + varint(value >> 7)


def proto(*fields: tuple[int, object]) -> bytes:
    """Protocol Buffers: an int is a varint, bytes and text have their length before them, and what struct packs is
    given as (format, value)."""
    out = b""
    for number, value in fields:
        if isinstance(value, int):
            out += varint(number << 3) + varint(value)
        elif isinstance(value, tuple):
            packed = struct.pack(*value)
            out += varint(number << 3 | (5 if len(packed) == 4 else 1)) + packed
        else:
            data = value.encode() if isinstance(value, str) else value
            out += varint(number << 3 | 2) + varint(len(data)) + data
    return out


FOXGLOVE = {7: 7, 4: 3}  # foxglove.PackedElementField, by sensor_msgs/PointField


def foxglove_head(time_ns: int, frame: str = "lidar") -> list[tuple[int, object]]:
    pose = proto((1, proto()), (2, proto((4, ("<d", 1.0)))))
    return [(1, proto((1, time_ns // 10**9), (2, time_ns % 10**9))), (2, frame), (3, pose)]


def foxglove_cloud(time_ns: int, points: numpy.ndarray, frame: str = "lidar") -> tuple[str, bytes]:
    fields = [(5, proto((1, name), (2, ("<I", points.dtype.fields[name][1])), (3, FOXGLOVE[FORMATS[name]])))
              for name in points.dtype.names]
    return "foxglove.PointCloud", proto(*foxglove_head(time_ns, frame), (4, ("<I", points.itemsize)), *fields,
                                        (6, points.tobytes()))


def foxglove_scan(time_ns: int, ranges: numpy.ndarray, first: float, last: float) -> tuple[str, bytes]:
    return "foxglove.LaserScan", proto(*foxglove_head(time_ns), (4, ("<d", first)), (5, ("<d", last)),
                                       (6, ranges.astype("<f8").tobytes()), (7, b""))


def foxglove_cloud_in_cdr(time_ns: int, points: numpy.ndarray) -> tuple[str, bytes]:
    out = Cdr().header(time_ns, "lidar").put("d", 0, 0, 0, 0, 0, 0, 1).put("I", points.itemsize, len(points.dtype.names))
    for name in points.dtype.names:
        out.text(name).put("I", points.dtype.fields[name][1]).put("B", FOXGLOVE[FORMATS[name]])
    return "foxglove_msgs/msg/PointCloud", out.raw(points.tobytes()).message()


def foxglove_scan_in_cdr(time_ns: int, ranges: numpy.ndarray, first: float, last: float) -> tuple[str, bytes]:
    out = Cdr().header(time_ns, "lidar").put("d", 0, 0, 0, 0, 0, 0, 1, first, last).put("I", len(ranges)).put("d", *ranges)
    return "foxglove_msgs/msg/LaserScan", out.put("I", 0).message()


def livox(time_ns: int, points: numpy.ndarray) -> tuple[str, bytes]:
    out = Cdr().header(time_ns, "livox").put("Q", time_ns).put("I", len(points)).put("B", 1, 0, 0, 0).put("I", len(points))
    for x, y, z, _, time_s in points:
        out.put("I", round(time_s * 1e9)).put("f", x, y, z).put("B", 9, 0x10, 2)
    return "livox_ros_driver2/msg/CustomMsg", out.message()


def packets(kind: str, its: list[tuple[int, bytes]]) -> tuple[str, bytes]:
    """A lidar's own, with their times: VelodyneScan, NebulaPackets or PandarScan."""
    out = Cdr().header(its[0][0], "lidar").put("I", len(its))
    for time_ns, data in its:
        out.put("I", time_ns // 10**9, time_ns % 10**9)
        if kind == "nebula_msgs/msg/NebulaPackets":
            out.raw(data)
        elif kind == "velodyne_msgs/msg/VelodyneScan":
            out.bytes += data
        else:
            out.bytes += data.ljust(1500, b"\0")
            out.put("I", len(data))
    return kind, out.message()


Row = tuple[str, int, tuple[str, bytes]]  # topic, time, (type, message)


def zstd(data: bytes) -> bytes:
    return subprocess.run(["zstd", "-1", f"--stream-size={len(data)}"], input=data, capture_output=True, check=True,
                          timeout=60).stdout


def write_sqlite(path: pathlib.Path, rows: list[Row], encoding: str = "cdr") -> None:
    path.unlink(missing_ok=True)
    bag = sqlite3.connect(path)
    bag.executescript("""
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
          serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
          data BLOB NOT NULL);
        CREATE INDEX timestamp_idx ON messages (timestamp ASC);""")
    topics: dict[str, int] = {}
    for topic, time_ns, (kind, data) in rows:
        if topic not in topics:
            topics[topic] = len(topics) + 1
            bag.execute("INSERT INTO topics VALUES(?, ?, ?, ?, '')", (topics[topic], topic, kind, encoding))
        bag.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", (topics[topic], time_ns, data))
    bag.commit()
    bag.close()


def write_mcap(path: pathlib.Path, rows: list[Row], encoding: str = "cdr", compression: str = "") -> None:
    """All in one chunk."""
    def string(text: str) -> bytes:
        return struct.pack("<I", len(text)) + text.encode()

    def record(code: int, content: bytes) -> bytes:
        return struct.pack("<BQ", code, len(content)) + content

    channels: dict[str, int] = {}
    records = b""
    for topic, time_ns, (kind, data) in rows:
        if topic not in channels:
            its = channels[topic] = len(channels) + 1
            records += record(3, struct.pack("<H", its) + string(kind) + string("ros2msg") + string(""))
            records += record(4, struct.pack("<HH", its, its) + string(topic) + string(encoding) + string(""))
        records += record(5, struct.pack("<HIQQ", channels[topic], 0, time_ns, time_ns) + data)
    packed = zstd(records) if compression == "zstd" else records
    chunk = struct.pack("<QQQI", 0, 0, len(records), 0) + string(compression) + struct.pack("<Q", len(packed)) + packed
    path.write_bytes(b"\x89MCAP0\r\n" + record(1, string("ros2") + string("")) + record(6, chunk) +
                     record(15, bytes(4)) + record(2, bytes(20)) + b"\x89MCAP0\r\n")


def write_metadata(folder: pathlib.Path, files: list[str], compression: str = '""') -> None:
    listed = "".join(f"    - {name}\n" for name in files)
    (folder / "metadata.yaml").write_text(
        "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  duration:\n    nanoseconds: 1\n"
        "  topics_with_message_count:\n    - topic_metadata:\n        name: /points\n      message_count: 1\n"
        f"  compression_format: {compression}\n  compression_mode: FILE\n  relative_file_paths:\n{listed}"
        f"  files:\n    - path: {files[0]}\n      message_count: 1\n")


def ranges_of(at_s: numpy.ndarray, origin: tuple[float, float, float], ahead: numpy.ndarray) -> numpy.ndarray:
    """Along each direction to a street of two walls with a car that drives ahead and one that is parked; seen at each
    point's time from a car that drives 5 m/s along x."""
    start = numpy.stack([origin[0] + 5 * at_s, numpy.full_like(at_s, origin[1]), numpy.full_like(at_s, origin[2])])
    nearest = numpy.full_like(at_s, numpy.inf)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        for x_m, y_m, speed in ((12, 0, 8), (14, -6, 0)):
            low, high = numpy.array([x_m, y_m - 0.9, 0.2]), numpy.array([x_m + 4.4, y_m + 0.9, 1.5])
            move = numpy.stack([speed * at_s, 0 * at_s, 0 * at_s])
            ends = numpy.stack([(low[:, None] + move - start) / ahead, (high[:, None] + move - start) / ahead])
            enter, leave = ends.min(0).max(0), ends.max(0).min(0)
            nearest = numpy.where((enter < leave) & (enter > 0), numpy.minimum(nearest, enter), nearest)
        for axis, place in ((2, 0.0), (1, 9.0), (1, -9.0)):
            there = (place - start[axis]) / ahead[axis]
            nearest = numpy.where((there > 0) & (there < 80), numpy.minimum(nearest, there), nearest)
    return nearest + numpy.random.default_rng(round(at_s[0] * 1000)).normal(0, 0.01, len(at_s))


def street(seconds: float, is_scanner: bool) -> list[Row]:
    """Ten turns a second of 16 lasers, clockwise as their driver gives them, or of a 2D scanner; and poses at 50 Hz."""
    columns = 900
    rows: list[Row] = []
    for i in range(round(seconds * 50)):
        now = START_NS + i * 20_000_000
        rows.append(("/odom", now, odometry(now, 5 * i / 50, 0, 0, 5)))
        if i % 5:
            continue
        if is_scanner:
            angles = numpy.linspace(-2.35, 2.35, columns)
            at_s = i / 50 + numpy.arange(columns) * 0.075 / columns
            ranges = ranges_of(at_s, (0, 0, 0.4), numpy.stack([numpy.cos(angles), numpy.sin(angles), 0 * angles]))
            rows.append(("/scan", now, laser_scan(now, ranges, -2.35, 4.7 / (columns - 1), 0.075)))
            continue
        ring = numpy.tile(numpy.arange(16), columns)
        after_s = numpy.repeat(numpy.arange(columns) * 0.1 / columns, 16)
        azimuth, elevation = -after_s * 20 * math.pi, numpy.radians(2.0 * ring - 15)
        ahead = numpy.stack([numpy.cos(azimuth) * numpy.cos(elevation), numpy.sin(azimuth) * numpy.cos(elevation),
                             numpy.sin(elevation)])
        ranges = ranges_of(i / 50 + after_s, (0, 0, 1.6), ahead)
        is_seen = ranges < 80
        cloud = numpy.zeros(is_seen.sum(), [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2"), ("time", "<f4")])
        cloud["x"], cloud["y"], cloud["z"] = ranges[is_seen] * ahead[:, is_seen]
        cloud["ring"], cloud["time"] = ring[is_seen], after_s[is_seen]
        rows.append(("/points", now, point_cloud2(now, cloud)))
    return rows
