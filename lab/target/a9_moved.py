"""The runs of lab/data/cortex_a9.csv that are of frames with classes of a unit that turns and follows the ground, with
and without the key `moved`; a9_runs.py says what a run is.

Their cars are those of vehicles/ with classes and a frame every 40 ms (lab/target/CMakeLists.txt). The ground is renewed at
the end of every third of their frames.
"""

import re

import a9_perception
import a9_runs
import a9_turning

VEHICLES = a9_turning.VEHICLES
KINDS = {"_classes": "no", "_moved": "yes"}  # of the image and its car: what they say of `moved`
TRACKED = "roof_hdl64e"  # the vehicle that has an image with moving objects, too (a9_cores.py)
WARM_UP = 12
FRAMES = 3


def drive(vehicle: str) -> str:
    return f"simulate --vehicle {vehicle} --seed 1 --seconds 1 --moving"


def run_of(vehicle: str, kind: str) -> str:
    return f"moved_cost vehicle={vehicle} moved={KINDS[kind]}"


def images() -> list[str]:
    return [f"perception_cost-{vehicle}{kind}" for vehicle in VEHICLES for kind in KINDS]


def counted(place: a9_runs.Place, vehicle: str, kind: str, capture: str) -> list[a9_runs.Row]:
    """Fails if the classes are not those of `iog fuse`."""
    line, = a9_runs.counted(place, f"perception_cost-{vehicle}{kind}", capture)
    report = a9_runs.output_of(place.iog, "fuse", "--pcap", place.work / capture, "--vehicle-file",
                               place.images / f"vehicles/{vehicle}{kind}.toml")
    expected = re.search(r"^class run hash +(\w+)$", report, re.M).group(1)
    if a9_runs.pairs_of(line)["class_run_hash"] != expected:
        raise SystemExit(f"{run_of(vehicle, kind)}: its classes are not those of iog fuse")
    return a9_runs.counted_rows(line, run_of(vehicle, kind))


def modelled(place: a9_runs.Place, vehicle: str, kind: str, capture: str) -> list[a9_runs.Row]:
    """A mean frame, stage by stage."""
    stages = a9_perception.STAGES
    head, own = a9_runs.own_of(
        a9_runs.printed_by_model(place, "nominal", stages | a9_perception.OUTSIDE,
                                 place.images / f"perception_cost-{vehicle}{kind}", capture, FRAMES, WARM_UP),
        stages | a9_perception.OUTSIDE)
    counts = {"frames": FRAMES, "before": WARM_UP, "points": head["points_after"]}
    return a9_runs.modelled_rows(run_of(vehicle, kind), "nominal", counts,
                                 a9_runs.with_whole({stage: own[stage] for stage in stages}, "frame"))


def _of_all(place: a9_runs.Place, captures: dict[str, str], run) -> list:
    return [lambda v=vehicle, k=kind: run(place, v, k, captures[v]) for vehicle in VEHICLES for kind in KINDS]


def counted_runs(place: a9_runs.Place, captures: dict[str, str]) -> list:
    return _of_all(place, captures, counted)


def modelled_runs(place: a9_runs.Place, captures: dict[str, str]) -> list:
    return _of_all(place, captures, modelled)
