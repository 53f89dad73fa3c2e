"""A drive of KITTI's raw data: clouds, poses and labelled things, in numpy.

Times are seconds since the first pose, places metres east and north of it. x, y, z of a cloud are those of
the unit, which turns clockwise from rear to rear and looks forward at the cloud's time (Geiger and others,
"Vision meets robotics: the KITTI dataset", 2013).
"""

import dataclasses
import datetime
import pathlib
import xml.etree.ElementTree

import numpy as np

from trajectories import Trajectory, over_turns

# NIMA TR8350.2: the ellipsoid of WGS 84.
SEMI_MAJOR_M = 6_378_137.0
ECCENTRICITY_SQUARED = (2 - 1 / 298.257223563) / 298.257223563
LATITUDE, LONGITUDE, YAW = 0, 1, 5  # fields of oxts


def unix_s(line: str) -> float:
    """Of "2011-09-26 13:02:25.964389445"; to the microsecond."""
    whole, _, part = line.strip().partition(".")
    at = datetime.datetime.strptime(whole, "%Y-%m-%d %H:%M:%S").replace(tzinfo=datetime.timezone.utc)
    return at.timestamp() + int(part[:6].ljust(6, "0")) / 1e6


def times_in(path: pathlib.Path) -> np.ndarray:
    return np.array([unix_s(line) for line in path.read_text().splitlines() if line.strip()])


@dataclasses.dataclass(frozen=True)
class Thing:
    """A labelled box: its bottom's middle in the unit's frame, cloud by cloud, and its trajectory in the world, of
    which the hits are not counted yet."""

    kind: str
    height_m: float
    width_m: float
    length_m: float
    clouds: np.ndarray  # numbers
    places: np.ndarray  # x, y, z, yaw of each
    trajectory: Trajectory

    def holds(self, points: np.ndarray, place: np.ndarray, margin_m: float) -> np.ndarray:
        """Which points are in the box, made wider by the margin; from 0.1 m below it to 0.2 m above."""
        cosine, sine = np.cos(place[3]), np.sin(place[3])
        x, y = points[:, 0] - place[0], points[:, 1] - place[1]
        along, across = cosine * x + sine * y, cosine * y - sine * x
        return ((np.abs(along) < self.length_m / 2 + margin_m)
                & (np.abs(across) < self.width_m / 2 + margin_m)
                & (points[:, 2] > place[2] - 0.1) & (points[:, 2] < place[2] + self.height_m + 0.2))


class Drive:
    """unit_x_m, unit_y_m: where the unit is in the frame of the poses' receiver."""

    def __init__(self, folder: pathlib.Path, unit_x_m: float, unit_y_m: float):
        self.folder, self.unit = folder, (unit_x_m, unit_y_m)
        poses = times_in(folder / "oxts/timestamps.txt")
        self.begin_s = poses[0]
        self.pose_times = poses - self.begin_s
        rows = np.array([[float(word) for word in path.read_text().split()]
                         for path in sorted((folder / "oxts/data").glob("*.txt"))])
        self.x, self.y = places_of(rows[:, LATITUDE], rows[:, LONGITUDE])
        self.heading = np.unwrap(rows[:, YAW])
        self.forward = times_in(folder / "velodyne_points/timestamps.txt") - self.begin_s
        self.paths = sorted((folder / "velodyne_points/data").glob("*.bin"))
        if not len(self.paths) == len(self.forward):
            raise ValueError(f"{folder}: {len(self.paths)} clouds of {len(self.forward)} times")
        if not len(rows) == len(poses):
            raise ValueError(f"{folder}: {len(rows)} poses of {len(poses)} times")

    def __len__(self) -> int:
        return len(self.paths)

    def cloud(self, number: int) -> np.ndarray:
        return np.fromfile(self.paths[number], "<f4").reshape(-1, 4)[:, :3].astype(float)

    def metres(self) -> float:
        """How far it is."""
        return float(np.hypot(np.diff(self.x), np.diff(self.y)).sum())

    def pose(self, times: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Between two poses, and beyond the ends as there."""
        at = np.clip(np.searchsorted(self.pose_times, times, side="right") - 1, 0, len(self.pose_times) - 2)
        part = (times - self.pose_times[at]) / (self.pose_times[at + 1] - self.pose_times[at])
        return tuple(values[at] + part * (values[at + 1] - values[at])
                     for values in (self.x, self.y, self.heading))

    def at_turns(self, turns: np.ndarray) -> np.ndarray:
        """When the head has turned so far: 3.25 looks to the right in turn 3."""
        at = np.clip(np.floor(turns).astype(int), 0, len(self) - 2)
        return self.forward[at] + (turns - at) * (self.forward[at + 1] - self.forward[at])

    def turns_at(self, times: np.ndarray) -> np.ndarray:
        at = np.clip(np.searchsorted(self.forward, times, side="right") - 1, 0, len(self) - 2)
        return at + (times - self.forward[at]) / (self.forward[at + 1] - self.forward[at])

    def seen_at(self, number: int, points: np.ndarray) -> np.ndarray:
        return self.at_turns(number - np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi))

    def world(self, vehicle_x: np.ndarray, vehicle_y: np.ndarray, times: np.ndarray):
        x, y, heading = self.pose(times)
        cosine, sine = np.cos(heading), np.sin(heading)
        return x + cosine * vehicle_x - sine * vehicle_y, y + sine * vehicle_x + cosine * vehicle_y

    def unit_world(self, number: int, points: np.ndarray):
        """Where the points of a cloud are, as if the unit stood upright."""
        return self.world(points[:, 0] + self.unit[0], points[:, 1] + self.unit[1],
                          self.seen_at(number, points))

    def things(self) -> list[Thing]:
        """Of tracklet_labels.xml; none if it is not there."""
        path = self.folder / "tracklet_labels.xml"
        if not path.is_file():
            return []
        items = xml.etree.ElementTree.parse(path).getroot().find("tracklets").findall("item")
        return [thing for number, item in enumerate(items) if (thing := self._thing(str(number), item))]

    def _thing(self, name: str, item) -> Thing | None:
        height, width, length = (float(item.find(name).text) for name in ("h", "w", "l"))
        places = np.array([[float(pose.find(name).text) for name in ("tx", "ty", "tz", "rz")]
                           for pose in item.find("poses").findall("item")])
        clouds = int(item.find("first_frame").text) + np.arange(len(places))
        places, clouds = places[clouds < len(self)], clouds[clouds < len(self)]
        if not len(clouds):
            return None
        times = np.array([self.seen_at(number, place[None])[0] for number, place in zip(clouds, places)])
        x, y = self.world(places[:, 0] + self.unit[0], places[:, 1] + self.unit[1], times)
        speeds = np.hypot(over_turns(times, x), over_turns(times, y))
        kind = item.find("objectType").text
        return Thing(kind, height, width, length, clouds, places, Trajectory(
            name, kind, length, width, times, x, y, places[:, 3] + self.pose(times)[2], speeds,
            np.hypot(places[:, 0], places[:, 1]), np.zeros(len(x), int)))


def places_of(latitudes: np.ndarray, longitudes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """East and north of the first, with the radii of curvature there: to millimetres over a kilometre."""
    sine = np.sin(np.radians(latitudes[0]))
    across = SEMI_MAJOR_M / np.sqrt(1 - ECCENTRICITY_SQUARED * sine**2)
    along = across * (1 - ECCENTRICITY_SQUARED) / (1 - ECCENTRICITY_SQUARED * sine**2)
    return (np.radians(longitudes - longitudes[0]) * across * np.cos(np.radians(latitudes[0])),
            np.radians(latitudes - latitudes[0]) * along)
