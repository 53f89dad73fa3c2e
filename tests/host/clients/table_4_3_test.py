"""Table 4.3 of the thesis for other cells and other epsilons, as clients/python reads it of the stream of `iog fuse`.

One point straight ahead of a sensor at the corner of a cell. Size of the cells and epsilon are the stream's; what is
expected follows from theorem 6 as printed (with the factor 1/2, docs/model.md, section 4) and from the sampling rule of
section 5 in whole millimetres.
"""

import itertools
import math
import re
import unittest

import streams

import iogrid
import numpy

CELLS_MM, EPSILONS, POLICIES = (50, 100, 200, 500), (0.01, 0.05, 0.1), ("blurring", "nearest")
PRINTED = {"blurring": [-14, -7, 0, 2, 0, 0], "nearest": [-15, -7, 0, 2, 1, 0]}  # at 0.05; k - 3 to k + 2
RANGE_MM, LEAST_ISM = 25_000, 0.05
CAR = """name = "one_beam"
epsilon = {epsilon}
quantisation = "{policy}"
grids = "indexes"
grid = {{ cell_m = {cell_m} }}
footprint = {{ x_min_m = -0.3, x_max_m = 0.3, y_min_m = -0.3, y_max_m = 0.3 }}
[[sensors]]
name = "front"
type = "points"
mount = {{ x_m = 0, y_m = 0.025, z_m = 1 }}
range_max_mm = {range_mm}
precision_mm = {precision_mm}
sigma_m = {sigma_m}
scan_width_ticks = 8640
layers = {{ from_deg = -1, to_deg = 1, count = 3 }}
max_points_per_scan = 4_000
"""


def frame_of(cell_mm: int, epsilon: float, policy: str, precision_mm: int, z_mm: int) -> iogrid.Frame:
    streams.FOLDER.mkdir(parents=True, exist_ok=True)
    car, cloud, capture, stream = (streams.FOLDER / name for name in ("it.toml", "it.bin", "it.pcap", "stream.pcap"))
    car.write_text(CAR.format(epsilon=epsilon, policy=policy, cell_m=cell_mm / 1000, range_mm=RANGE_MM,
                              precision_mm=precision_mm, sigma_m=precision_mm / 1000))
    numpy.array([[z_mm / 1000, 0, 0, 0]], "<f4").tofile(cloud)
    streams.iog("points", cloud, "--vehicle-file", car, "--out", capture)
    streams.iog("fuse", "--vehicle-file", car, "--pcap", capture, "--stream", stream)
    frame, = iogrid.replay(stream)
    return frame


def isms(k: int, precision_mm: int) -> list[float]:
    """Of each 1D cell by theorem 6, in cells of 1 and sigma 1; 2^k has been multiplied into both sums."""
    likelihood = [math.exp(-(h - k) ** 2 / 2) for h in range(RANGE_MM // precision_mm)]
    weighed = [each * 2.0 ** (k - h) for h, each in enumerate(likelihood)]
    alpha, before = 2 * sum(weighed), itertools.accumulate(weighed, initial=0.0)
    return [max(LEAST_ISM, (sum_before + 2 * own) / alpha) for sum_before, own in zip(before, weighed)]


def quantised(p: float, epsilon: float, policy: str) -> int:
    exact = math.log((1 - p) / p) / math.log((0.5 - epsilon) / (0.5 + epsilon))
    nearest = min((math.floor(exact), math.ceil(exact)), key=lambda n: abs(iogrid.probability(n, epsilon) - p))
    return math.trunc(exact) if policy == "blurring" else nearest


def cell_of_line(cell: int, cell_mm: int, precision_mm: int, z_mm: int) -> int:
    """The 1D cell of a 2D cell of the line, by the sampling rule."""
    k, hit = z_mm // precision_mm, z_mm // cell_mm
    if cell < hit:
        return min(k - 1, ((cell + 1) * cell_mm - 1) // precision_mm)
    return k if cell == hit else max(k + 1, cell * cell_mm // precision_mm)


class Table43(unittest.TestCase):
    def line_of(self, cell_mm: int, epsilon: float, policy: str, precision_mm: int) -> list[int]:
        """Indexes from k - 3 to k + 2, after all of the line has been compared."""
        z_mm = 10_000 + cell_mm // 2
        frame = frame_of(cell_mm, epsilon, policy, precision_mm, z_mm)
        said = frame.geometry
        self.assertEqual((frame.is_whole, frame.points_used, said.epsilon), (True, 1, epsilon))
        row, first = said.index(0.001, 0.026)
        stream_mm = round(said.cell_m * 1000)
        self.assertEqual(stream_mm, cell_mm)
        model = isms(z_mm // precision_mm, precision_mm)
        expected = [quantised(model[cell_of_line(cell, stream_mm, precision_mm, z_mm)], said.epsilon, policy)
                    for cell in range(RANGE_MM // stream_mm)]
        line = frame.indexes[row, first:first + len(expected)]
        self.assertEqual(line.tolist(), expected)
        self.assertEqual(numpy.count_nonzero(frame.indexes), numpy.count_nonzero(line), "beside the line")
        hit = z_mm // cell_mm
        return line[hit - 3:hit + 3].tolist()

    def test_of_1d_cells_as_long_as_the_grids(self):
        """The row depends on epsilon alone, and is docs/model.md's."""
        text = (streams.ROOT / "docs/model.md").read_text().replace("\u2212", "-")
        documented = {(float(epsilon), policy): [int(index) for index in indexes.split("|")] for epsilon, policy, indexes
                      in re.findall(r"^\| (0\.\d+) \| (blurring|nearest) \| (.*) \|$", text, re.M)}
        for cell_mm, epsilon, policy in itertools.product(CELLS_MM, EPSILONS, POLICIES):
            with self.subTest(cell_mm=cell_mm, epsilon=epsilon, policy=policy):
                line = self.line_of(cell_mm, epsilon, policy, cell_mm)
                self.assertEqual(line, documented[epsilon, policy])
                self.assertTrue(epsilon != 0.05 or line == PRINTED[policy])

    def test_of_1d_cells_of_10_cm(self):
        for cell_mm, epsilon in itertools.product((50, 200, 500), EPSILONS):
            with self.subTest(cell_mm=cell_mm, epsilon=epsilon):
                self.line_of(cell_mm, epsilon, "blurring", 100)


if __name__ == "__main__":
    unittest.main()
