"""The bags of tests/e2e/bags and `iog` with the car that they fit."""

import pathlib
import subprocess

import numpy

import made_bags
from made_bags import START_NS

SCANS = 8
CAR = """name = "robot"
z_min_m = 0.05
z_max_m = 0.60
footprint = { x_min_m = -0.3, x_max_m = 0.3, y_min_m = -0.2, y_max_m = 0.2 }
[[sensors]]
name = "front"
type = "points"
mount = { x_m = 0, y_m = 0, z_m = 0.2 }
scan_width_ticks = 5760
layers = { from_deg = 0, to_deg = 0, count = 1 }
max_points_per_scan = 400
"""


def scans() -> list[made_bags.Row]:
    """A wall 5 m away, all around, and a robot that drives."""
    noise = numpy.random.default_rng(1)
    rows: list[made_bags.Row] = []
    for i in range(SCANS):
        now = START_NS + i * 50_000_000
        ranges = 5 + noise.normal(0, 0.01, 360)
        rows.append(("/odom", now, made_bags.odometry(now, 0.05 * i, 0, 0, 1)))
        rows.append(("/scan", now, made_bags.laser_scan(now, ranges, -1.57, 3.14 / 360, 0.04)))
    return rows


class Program:
    def __init__(self, iog: str, folder: pathlib.Path):
        self.iog, self.folder, self.car = iog, folder, folder / "robot.toml"
        self.car.write_text(CAR)

    def run(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([self.iog, *words, "--vehicle-file", self.car], capture_output=True, text=True,
                              check=False, timeout=60)

    def capture_of(self, bag: pathlib.Path, said: str = "") -> bytes:
        out = self.folder / "out.pcap"
        answer = self.run("points", bag, "--out", out)
        assert answer.returncode == 0, (bag, answer.stderr)
        assert said in answer.stdout, answer.stdout
        return out.read_bytes()

    def check_error(self, bag: pathlib.Path, words: str) -> None:
        """One line, for clouds and, with the same words, for poses."""
        for command in (["points", bag, "--vehicle-file", self.car, "--out", self.folder / "none.pcap"],
                        ["pose", "--from", bag, "--out", self.folder / "none.pcap"]):
            answer = subprocess.run([self.iog, *command], capture_output=True, text=True, check=False, timeout=60)
            assert answer.returncode == 2 and words in answer.stderr, (command, answer)
            assert len(answer.stderr.splitlines()) == 1, answer.stderr


def folder_of(path: pathlib.Path) -> pathlib.Path:
    path.mkdir(exist_ok=True)
    for old in path.iterdir():
        old.unlink()
    return path
