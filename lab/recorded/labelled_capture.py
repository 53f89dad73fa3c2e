"""A recorded drive as a capture with labels: what the classes say of its hits, in numpy.

The folder has, of one drive,

  NAME.pcap or NAME.pcap.xz   what the unit sent, with poses
  poses.csv   time_s, x_m, y_m, heading_deg: the same poses
  truth.npz   t0_s and, for each return: turn; t_us after t0; xyz in the unit's frame in 2 mm; label, a class of
              PandaSet's; box, 0 for none; height over the labelled ground in mm
  boxes.csv   for each turn and box: kind, motion, speed_m_s, and the box in the world: x_m, y_m, width_m, length_m,
              yaw_rad of its width, to the right of its length

A hit is a return 0.35 to 2.1 m over the labelled ground, below 50 m and not on the car itself. Its cell is where the
pose in the middle of its slice puts it. It counts by the first frame that has taken it.
"""

import csv
import lzma
import pathlib
import shutil

import numpy as np

from car import Car
from evaluate import (ARRIVES_WITHIN_S, FIRST_CLOUD, OWN_MARGIN_M, Counts, Frames, Results, areas_of, said_of)
from trajectories import MOVES_ABOVE_MPS, Trajectory, speed_band

GROUND = np.arange(6, 13)
ROADS = {"road": (7, 8, 9, 10), "sidewalk": (11,)}
STANDING = {"vegetation": (5,), "cone, sign, barrier": range(34, 41), "building": (41,), "other that stands": (42,)}
CYCLES = {"Bicycle", "Motorcycle", "Motorized Scooter", "Personal Mobility Device"}
UNIT_M = 0.002
LOW_MM, HIGH_MM, HIGHEST_OF_THINGS_MM = 350, 2100, 2500
RANGES_M = [(0, 25), (25, 50)]
CLEAR_CELLS = 3  # of 0.1 m, between the road and things
GAP_S = 0.7      # after turns that are missing
SAME_AZIMUTH_DEG, SAME_RANGE_M = 0.15, 0.03


def kind_of(row: dict[str, str]) -> str:
    if "Pedestrian" in row["kind"]:
        return "pedestrian"
    if row["kind"] in CYCLES:
        return "cycle"
    return "parked vehicle" if row["motion"] == "Parked" and float(row["speed_m_s"]) <= 0.3 else "vehicle"


def beams_of(points: np.ndarray, elevations_deg: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The laser that is nearest, counted by elevation, the range, and the azimuth in degrees."""
    rising = np.sort(elevations_deg)
    range_m = np.linalg.norm(points, axis=1)
    laser = np.searchsorted((rising[1:] + rising[:-1]) / 2, np.degrees(np.arcsin(points[:, 2] / range_m)))
    return laser, range_m, np.degrees(np.arctan2(points[:, 1], points[:, 0])) % 360


class LabelledCapture:
    SETTINGS = ("both", "both, followed")

    def __init__(self, folder: pathlib.Path, _car: str):
        found = [*folder.glob("*.pcap"), *folder.glob("*.pcap.xz")]
        if len(found) != 1:
            raise ValueError(f"{folder}: {len(found)} captures; one is needed, .pcap or .pcap.xz")
        self.packed, self.name = found[0], found[0].name.partition(".pcap")[0]
        with np.load(folder / "truth.npz") as truth:
            self.begin_s = float(truth["t0_s"])
            self.turn, self.label, self.box, self.height_mm = (
                truth[name] for name in ("turn", "label", "box", "height"))
            self.times, self.points = truth["t_us"] * 1e-6, truth["xyz"] * UNIT_M
        self.r = np.hypot(self.points[:, 0], self.points[:, 1])
        pose = np.genfromtxt(folder / "poses.csv", delimiter=",", names=True)
        self.pose_times = pose["time_s"] - self.begin_s
        self.poses = (pose["x_m"], pose["y_m"], np.unwrap(np.radians(pose["heading_deg"])))
        with open(folder / "boxes.csv", encoding="utf-8") as rows:
            self.boxes = list(csv.DictReader(rows))
        # The row of each return's box in its turn; -1 for none.
        keys = np.array([int(row["turn"]) << 16 | int(row["box"]) for row in self.boxes])
        order, of_returns = np.argsort(keys), self.turn.astype(np.int64) << 16 | self.box
        at = order[np.searchsorted(keys, of_returns, sorter=order).clip(0, len(keys) - 1)]
        self.row = np.where(keys[at] == of_returns, at, -1)
        self.is_ground = np.isin(self.label, GROUND)
        self.is_hit = ~self.is_ground & (self.height_mm > LOW_MM) & (self.height_mm < HIGH_MM)

    def __len__(self) -> int:
        return len(np.unique(self.turn))

    def metres(self) -> float:
        x, y, _ = self.poses
        return float(np.hypot(np.diff(x), np.diff(y)).sum())

    def capture(self, work: pathlib.Path, _car: pathlib.Path) -> pathlib.Path:
        if self.packed.suffix != ".xz":
            return self.packed
        with lzma.open(self.packed) as packed, open(work / "drive.pcap", "wb") as out:
            shutil.copyfileobj(packed, out)
        return work / "drive.pcap"

    def world(self, vehicle: np.ndarray, slice_s: float) -> tuple[np.ndarray, np.ndarray]:
        slices = (np.floor((self.times + self.begin_s) / slice_s) + 0.5) * slice_s - self.begin_s
        x, y, heading = (np.interp(slices, self.pose_times, values) for values in self.poses)
        cosine, sine = np.cos(heading), np.sin(heading)
        return (x + cosine * vehicle[:, 0] - sine * vehicle[:, 1], y + sine * vehicle[:, 0] + cosine * vehicle[:, 1])

    def clear_of_things(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Whether no cell within CLEAR_CELLS has a return of a labelled thing."""
        column, row = (np.floor((values - values.min()) * 10).astype(int) + CLEAR_CELLS for values in (x, y))
        things = ~self.is_ground & (self.label >= 5) & (self.height_mm <= HIGHEST_OF_THINGS_MM)
        taken = np.zeros((row.max() + CLEAR_CELLS + 1, column.max() + CLEAR_CELLS + 1), bool)
        taken[row[things], column[things]] = True
        for axis in (0, 1):
            taken = np.any([np.roll(taken, by, axis) for by in range(-CLEAR_CELLS, CLEAR_CELLS + 1)], axis=0)
        return ~taken[row, column]

    def evaluate(self, text: str, frames: Frames) -> Results:
        car = Car(text)
        vehicle = car.in_vehicle(self.points)
        x, y = self.world(vehicle, frames.slice_s)
        frame = np.searchsorted(frames.ends_s - self.begin_s, self.times + ARRIVES_WITHIN_S)
        on_road = np.isin(self.label, [one for labels in ROADS.values() for one in labels])
        used = np.flatnonzero((self.turn >= FIRST_CLOUD) & (frame < len(frames)) & (self.is_hit | on_road)
                              & ~car.is_own(vehicle, OWN_MARGIN_M) & (self.is_hit | self.clear_of_things(x, y)))
        alone, named = said_of(frames, frame[used], x[used], y[used], self.is_hit[used])
        return Results(self.counted(used, alone, named), np.mean([areas_of(frames, last) for last in self.last_frames(
            frame[used], used)], axis=0), self.of_things(used, named), self.trajectories())

    def last_frames(self, frame: np.ndarray, used: np.ndarray) -> np.ndarray:
        last = np.zeros(256, int)
        np.maximum.at(last, self.turn[used], frame)
        return last[last > 0]

    def taken_for_ground(self, text: str, path: pathlib.Path) -> tuple[int, int]:
        """Hits on vehicles, and how many of them were taken for ground, by the list of point_fates: it has a return
        of the same laser and turn, at the same azimuth and range."""
        car, ground, turns = Car(text), np.fromfile(path, "<i8").reshape(-1, 4), np.unique(self.turn)
        elevations = np.array([laser["elevation_deg"] for laser in car.unit["lasers"]])
        is_vehicle = np.array([kind_of(box).endswith("vehicle") for box in self.boxes])
        hits = np.flatnonzero(self.is_hit & (self.row >= 0) & is_vehicle[self.row])
        begins = np.array([self.times[self.turn == turn].min() for turn in turns]) + self.begin_s
        laser, range_m, azimuth = beams_of((ground[:, 1:] / 1e3 - car.place) @ car.turn, elevations)
        beam = (turns[np.searchsorted(begins, ground[:, 0] / 1e6) - 1] * 128.0 + laser) * 360 + azimuth
        order = np.argsort(beam)
        laser, hit_range_m, azimuth = beams_of(self.points[hits], elevations)
        hit_beam = (self.turn[hits] * 128.0 + laser) * 360 + azimuth
        after = np.searchsorted(beam, hit_beam, sorter=order)
        found = np.zeros(len(hits), bool)
        for beside in (order[(after - 1).clip(0)], order[after.clip(max=len(order) - 1)]):
            found |= ((np.abs(beam[beside] - hit_beam) < SAME_AZIMUTH_DEG)
                      & (np.abs(range_m[beside] - hit_range_m) < SAME_RANGE_M))
        return len(hits), int(found.sum())

    def counted(self, used: np.ndarray, alone: np.ndarray, named: np.ndarray) -> list[list]:
        counts, r, label, row = Counts(), self.r[used], self.label[used], self.row[used]
        bands = [(band, (r >= band[0]) & (r < band[1])) for band in RANGES_M]
        for kind, labels in (STANDING | ROADS).items():
            for band, within in bands:
                counts.add(kind, "", band, np.isin(label, labels) & within, alone, named)
        sorts = [(kind_of(box), speed_band(float(box["speed_m_s"]))) for box in self.boxes]
        number = {sort: i for i, sort in enumerate(sorted(set(sorts)))}
        sort_of_hit = np.where((row >= 0) & self.is_hit[used], np.array([number[sort] for sort in sorts])[row], -1)
        for sort, i in number.items():
            for band, within in bands:
                counts.add(*sort, band, (sort_of_hit == i) & within, alone, named)
        return counts.rows()

    def of_things(self, used: np.ndarray, named: np.ndarray) -> list[list]:
        """A row for each thing while it moves, and apart from it the time after turns that are missing."""
        turns = np.unique(self.turn)
        begins = np.array([self.times[self.turn == turn].min() for turn in turns[1:][np.diff(turns) > 1]])
        since = self.times[used, None] - begins[None, :]
        after_gap = ((since >= 0) & (since < GAP_S)).any(axis=1)
        moving = np.array([float(box["speed_m_s"]) > MOVES_ABOVE_MPS for box in self.boxes])
        moves = self.is_hit[used] & (self.row[used] >= 0) & moving[self.row[used]]
        counts = Counts()
        for thing in np.unique(self.box[used][moves]):
            its = moves & (self.box[used] == thing)
            kind = kind_of(self.boxes[self.row[used][its][0]])
            for gap in (0, 1):
                counts.count((int(thing), kind, gap), named[its & (after_gap == gap)])
        return counts.rows()

    def trajectories(self) -> list[Trajectory]:
        """Of the boxes that move at some time; a box is where it is when its returns were seen."""
        order = np.argsort(self.row, kind="stable")
        ends = np.searchsorted(self.row[order], np.arange(len(self.boxes) + 1))
        seen = {}
        for number, box in enumerate(self.boxes):
            its = order[ends[number]:ends[number + 1]]
            if len(its):
                seen.setdefault(box["box"], []).append(
                    (np.median(self.times[its]), *(float(box[name]) for name in ("x_m", "y_m")),
                     float(box["yaw_rad"]) + np.pi / 2, float(box["speed_m_s"]), np.median(self.r[its]),
                     self.is_hit[its].sum()))
        first = {box["box"]: box for box in reversed(self.boxes)}
        paths = [Trajectory(thing, kind_of(first[thing]), float(first[thing]["length_m"]),
                            float(first[thing]["width_m"]), *np.array(rows).T) for thing, rows in seen.items()]
        return [path for path in paths if (path.speeds_mps > MOVES_ABOVE_MPS).any()]
