#!/usr/bin/python3
"""What the class grids of recorded drives say of their hits, and the published objects of what moves.

  lab/recorded/measure.py --out FOLDER [--setting NAME]... DRIVE CAR.toml [DRIVE CAR.toml]...

A drive is a folder of one of two kinds, and its car's first sensor is the unit as it was mounted:

- KITTI's raw data, with tracklet_labels.xml if things are to be told apart. The unit is a velodyne_hdl64e_s2 with its
  lasers; the origin of the car's frame is under the receiver of the poses. `iog convert` makes packets.
- A capture with labels (lab/recorded/labelled_capture.py says what is in it).

`class_frames` fuses the packets as the firmware does, once for each setting, and evaluate.py or labelled_capture.py
counts, into recorded_*.csv. Needs `iog`, `class_frames` and `point_fates` of build/host.
"""

import argparse
import csv
import dataclasses
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True

import numpy as np

import car as cars
import evaluate
from drive import Drive
from labelled_capture import LabelledCapture
from trajectories import MOVES_ABOVE_MPS, MovingObjects, Trajectory, followed

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "lab"))
import measurements  # noqa: E402 ; it lies in lab/

HOST = ROOT / "build/host"
NAME = "recorded"  # of the car, as its file is called here


@dataclasses.dataclass(frozen=True)
class Setting:
    """The car's file with these keys of the car and of its sensor, and its sensor pitched by so much more; hits are
    judged by the mount of the file."""

    car: dict[str, str] = dataclasses.field(default_factory=dict)
    sensor: dict[str, str] = dataclasses.field(default_factory=dict)
    pitch_off_deg: float = 0


# A frame is 40 ms long, as a LUX scans; the rest is what a car's file says if it says nothing.
SCAN = {"frame_period_us": "40_000", "grids": '"classes"', "objects": "false"}
BAND = {"ground": "false"}
GROUND = {"ground": "{ low_m = 0.22, top_m = 2.2 }"}
BOTH = GROUND | {"moved": "{ low_m = 0.6, tall_m = 0.4 }"}
SETTINGS = {
    "flat band": Setting(SCAN, BAND),
    "ground": Setting(SCAN, GROUND | {"moved": "false"}),
    "opened from below": Setting(SCAN, BAND | {"moved": "{ low_m = 0.6, tall_m = 0.7 }"}),
    # Of the last one the page says whether its goals are met.
    "both, followed": Setting(SCAN | {"objects": "true"}, BOTH),
    "both, pitch 0.4° more": Setting(SCAN, BOTH, 0.4),
    "both, pitch 0.81° less": Setting(SCAN, BOTH, -0.81),  # of this drive that is level, as in a data sheet
    "both, pitch 1° less": Setting(SCAN, BOTH, -1),
    "both": Setting(SCAN, BOTH),
}
RUN_COUNTS = {  # of class_frames' table
    "packets_placed": r"packets placed +(\d+)", "packets_not_placed": r"packets placed .* (\d+) without a place",
    "points_used": r"scan points +(\d+) used", "slices_placed": r"slices +(\d+) placed",
}


def output_of(*words) -> str:
    done = subprocess.run([str(word) for word in words], check=False, text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"measure.py: {words[0]}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def run_counts(text: str) -> list[int]:
    found = {name: re.search(pattern, text) for name, pattern in RUN_COUNTS.items()}
    if missing := [name for name, match in found.items() if not match]:
        sys.exit(f"measure.py: class_frames does not say {', '.join(missing)}:\n{text}")
    return [int(match[1]) for match in found.values()]


class KittiRaw(Drive):
    SETTINGS = tuple(SETTINGS)

    def __init__(self, folder: pathlib.Path, car: str):
        super().__init__(folder, *cars.Hdl64e(car).place[:2])
        self.name, self.place = folder.resolve().name, evaluate.Place(self)

    def capture(self, work: pathlib.Path, car: pathlib.Path) -> pathlib.Path:
        made = work / "drive.pcap"
        output_of(HOST / "tools/iog", "convert", "--kitti", self.folder, "--vehicle-file", car, "--out", made)
        return made

    def evaluate(self, car: str, frames: evaluate.Frames) -> evaluate.Results:
        return evaluate.evaluate(self, self.place, cars.Hdl64e(car), frames)


KINDS = {"velodyne_points": KittiRaw, "truth.npz": LabelledCapture}  # by what their folders have


def drive_in(folder: pathlib.Path, car: str) -> KittiRaw | LabelledCapture:
    for part, kind in KINDS.items():
        if (folder / part).exists():
            return kind(folder, car)
    raise ValueError(f"has neither {' nor '.join(KINDS)}")


class Tables:
    """The rows of recorded_*.csv; each begins with its drive and its setting."""

    COLUMNS = {
        "hits": evaluate.Counts.COLUMNS,
        "areas": ["within_m", "free_m2", "moving_m2", "standing_m2", "open_m2"],
        "things": [*evaluate.Counts.THINGS, "from_m", "to_m", "from_mps", "to_mps"],
        "ground": ["kind", "hits", "ground_hits"],
        "velocities": ["thing", "kind", "delay_s", "frames", "median_error_mps"],
        "runs": ["measured_at", "metres", "pitch_deg", "mount_z_m", "band_low_m", "band_high_m", "turns", "frames",
                 *RUN_COUNTS],
    }

    def __init__(self):
        self.rows = {name: [] for name in self.COLUMNS}

    def add(self, table: str, drive: str, setting: str, rows: list[list]) -> None:
        self.rows[table] += [[drive, setting, *row] for row in rows]

    def write(self, folder: pathlib.Path) -> None:
        for name, columns in self.COLUMNS.items():
            with open(folder / f"recorded_{name}.csv", "w", newline="") as out:
                csv.writer(out, lineterminator="\n").writerows([["drive", "setting", *columns], *self.rows[name]])


def ranges_of(its: Trajectory) -> list[str]:
    """Its distances and speeds while it moves and is hit."""
    while_moving = (its.speeds_mps > MOVES_ABOVE_MPS) & (its.hits > 0)
    return [f"{side(values[while_moving]):.1f}" if while_moving.any() else ""
            for values in (its.away_m, its.speeds_mps) for side in (np.min, np.max)]


def velocities(trajectories: list[Trajectory], objects: MovingObjects) -> list[list]:
    """A row for each thing that is seen while it moves, and one for the frames of all."""
    rows = [[its.thing, its.kind, result.delay_s, result.errors_mps]
            for its in sorted(trajectories, key=lambda its: int(its.thing)) if (result := followed(its, objects))]
    if rows:
        rows.append(["all", "", np.median([row[2] for row in rows]), np.concatenate([row[3] for row in rows])])
    return [[thing, kind, f"{delay_s:.2f}", len(errors), f"{np.median(errors) if len(errors) else np.nan:.2f}"]
            for thing, kind, delay_s, errors in rows]


def measure(drive: KittiRaw | LabelledCapture, text: str, settings: list[str], work: pathlib.Path,
            tables: Tables) -> None:
    grids, moving, car_file = work / "grids", work / "moving.csv", work / f"{NAME}.toml"
    car_file.write_text(cars.with_keys(text, NAME, {}, {}))
    capture = drive.capture(work, car_file)
    for setting in settings:
        keys = SETTINGS[setting]
        changed = cars.with_keys(text, NAME, keys.car, keys.sensor)
        car_file.write_text(cars.pitched(changed, keys.pitch_off_deg))
        said = output_of(HOST / "lab/recorded/class_frames", capture, car_file, grids, moving)
        frames, car = evaluate.Frames(grids), cars.Car(changed)
        results = drive.evaluate(changed, frames)
        paths = {int(its.thing): its for its in results.trajectories}
        tables.add("hits", drive.name, setting, results.hits)
        tables.add("areas", drive.name, setting,
                   [[evaluate.AREA_WITHIN_M, *(f"{area:.2f}" for area in results.areas)]])
        tables.add("things", drive.name, setting, [[*row, *ranges_of(paths[row[0]])] for row in results.things])
        if keys.car.get("objects") == "true":
            tables.add("velocities", drive.name, setting,
                       velocities(results.trajectories, MovingObjects(moving, drive.begin_s)))
        tables.add("runs", drive.name, setting, [[
            measurements.commit(), f"{drive.metres():.0f}", car.pitch_deg, car.place[2], car.low_m, car.high_m,
            len(drive), len(frames), *run_counts(said)]])
    if settings and isinstance(drive, LabelledCapture):  # each of its returns has a label
        ground = work / "ground"
        output_of(HOST / "lab/labelled/point_fates", capture, car_file, ground)
        tables.add("ground", drive.name, setting, [["vehicle", *drive.taken_for_ground(changed, ground)]])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drives", metavar="DRIVE CAR.toml", type=pathlib.Path, nargs="+")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--setting", action="append", choices=SETTINGS)
    options = parser.parse_args()
    if len(options.drives) % 2:
        parser.error("each drive needs its car")
    tables = Tables()
    for folder, car in zip(options.drives[::2], options.drives[1::2]):
        try:
            drive = drive_in(folder, text := car.read_text())
        except (KeyError, OSError, ValueError) as error:
            sys.exit(f"measure.py: {folder} with {car}: {error}")
        chosen = [name for name in drive.SETTINGS if name in (options.setting or SETTINGS)]
        with tempfile.TemporaryDirectory() as work:
            measure(drive, text, chosen, pathlib.Path(work), tables)
    tables.write(options.out)


if __name__ == "__main__":
    main()
