#!/usr/bin/python3
"""What the class grids of a recorded drive say of its hits.

  lab/recorded/measure.py --drive FOLDER --car CAR.toml --out FOLDER [--setting NAME]...

The drive is a folder of KITTI's raw data, with tracklet_labels.xml if things are to be told apart. The car has
one velodyne_hdl64e_s2 with the lasers of that unit, mounted as it was; the origin of its frame is under the
receiver of the poses. `iog convert` makes packets, `class_frames` fuses them as the firmware does, once for each
setting, and lab/recorded/evaluate.py counts, into recorded_*.csv. Needs `iog` and `class_frames` of
build/host.
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

import car as cars
import evaluate
from drive import Drive

ROOT = pathlib.Path(__file__).resolve().parents[2]
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


def write(path: pathlib.Path, columns: list[str], rows: list[list]) -> None:
    with open(path, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([columns, *rows])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drive", type=pathlib.Path, required=True)
    parser.add_argument("--car", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--setting", action="append", choices=SETTINGS)
    options = parser.parse_args()
    text = options.car.read_text()
    unit = cars.Car(text).place
    drive = Drive(options.drive, unit[0], unit[1])
    place = evaluate.Place(drive)
    hits, areas, runs = [], [], []
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        capture, grids, car_file = work / "drive.pcap", work / "grids", work / f"{NAME}.toml"
        car_file.write_text(cars.with_keys(text, NAME, {}, {}))
        output_of(HOST / "tools/iog", "convert", "--kitti", options.drive, "--vehicle-file", car_file,
                  "--out", capture)
        for setting in options.setting or SETTINGS:
            keys = SETTINGS[setting]
            changed = cars.with_keys(text, NAME, keys.car, keys.sensor)
            car_file.write_text(cars.pitched(changed, keys.pitch_off_deg))
            said = output_of(HOST / "lab/recorded/class_frames", capture, car_file, grids)
            frames = evaluate.Frames(grids)
            its_car = cars.Car(changed)
            its_hits, its_areas = evaluate.evaluate(drive, place, its_car, frames)
            hits += [[setting, *row] for row in its_hits]
            areas.append([setting, evaluate.AREA_WITHIN_M, *(f"{area:.2f}" for area in its_areas)])
            runs.append([setting, options.drive.resolve().name, f"{drive.metres():.0f}", its_car.pitch_deg,
                         its_car.place[2], its_car.low_m, its_car.high_m, len(drive), len(frames), *run_counts(said)])
    write(options.out / "recorded_hits.csv", ["setting", *evaluate.Counts.COLUMNS], hits)
    write(options.out / "recorded_areas.csv",
          ["setting", "within_m", "free_m2", "moving_m2", "standing_m2", "open_m2"], areas)
    write(options.out / "recorded_runs.csv", ["setting", "drive", "metres", "pitch_deg", "mount_z_m", "band_low_m", "band_high_m", "clouds", "frames",
           *RUN_COUNTS], runs)


if __name__ == "__main__":
    main()
