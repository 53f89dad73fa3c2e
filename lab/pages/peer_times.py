"""Times of one frame on a PC, ours and other grid libraries': lab/data/peers.json, which Google
Benchmark wrote for lab/peers/run."""

import dataclasses
import functools
import json
import statistics

SCENES = ("city", "ring_road")
OURS = "ours"


@dataclasses.dataclass(frozen=True)
class Goal:
    peer: str
    what: str     # "fuse" or "both": fuse and clear
    ratio: float  # at least so many times our time


GOALS = (Goal("mrpt", "fuse", 4), Goal("octomap_clouds", "both", 400),
         Goal("octomap_rays", "both", 600))
# In the order of the page.
NAMES = {
    OURS: "**ours**, hits_win",
    "ours_bayes": "ours, bayes",
    "printed": "thesis as printed, up to the scan point",
    "printed_whole_beams": "thesis as printed, up to 50 m",
    "float_bayes": "Bayes in float",
    "float_log_odds": "log-odds in float",
    "mrpt": "MRPT, COccupancyGridMap2D",
    "octomap_clouds": "OctoMap, insertPointCloud",
    "octomap_rays": "OctoMap, insertRay",
}
WHAT = {"fuse": "fuse only", "both": "fuse and clear"}


@dataclasses.dataclass(frozen=True)
class Times:
    """The repetitions of one contender in one scene, in microseconds a frame."""

    fuse: tuple[float, ...]
    both: tuple[float, ...]  # fuse and clear
    free_cells: float        # of the first frame, as all below
    occupied_cells: float
    stored_cells: float

    def median(self, what: str) -> float:
        return statistics.median(getattr(self, what))

    @property
    def spread(self) -> float:
        """Half of what the middle half of the repetitions spans, as a share of the median."""
        if len(self.both) < 3:
            return 0
        lower, _, upper = statistics.quantiles(self.both, n=4, method="inclusive")
        return (upper - lower) / 2 / self.median("both")


class PeerTimes:
    def __init__(self, data):
        report = json.loads(data.path("peers.json").read_text())
        self.context = report["context"]
        self._runs = [run for run in report["benchmarks"] if run["run_type"] == "iteration"]

    @functools.cache
    def of(self, scene: str, name: str) -> Times:
        runs = [run for run in self._runs if run["name"].split("/")[:2] == [scene, name]]
        assert runs, f"lab/data/peers.json: no {scene}/{name}"
        return Times(tuple(run["fuse_us"] for run in runs),
                     tuple(run["fuse_us"] + run["clear_us"] for run in runs),
                     *(runs[0][f"{kind}_cells"] for kind in ("free", "occupied", "stored")))

    def ratio(self, scene: str, name: str, what: str) -> float:
        """How many times our time it needs."""
        return self.of(scene, name).median(what) / self.of(scene, OURS).median(what)

    def a_frame(self, scene: str, key: str) -> float:
        """A mean frame's beams, updates, ..., as the context of the report has them."""
        return int(self.context[f"{scene}_{key}"]) / self.frames(scene)

    def frames(self, scene: str) -> int:
        return int(self.context[f"{scene}_frames"])


def ratio_text(ratio: float) -> str:
    """Three digits: 7.24, 21.5, 1,234."""
    return f"{ratio:.2f}" if ratio < 10 else f"{ratio:.1f}" if ratio < 100 else f"{ratio:,.0f}"
