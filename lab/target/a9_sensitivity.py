"""The runs of lab/data/cortex_a9.csv that say how far the model's uncertain constants move the headlines of
docs/results/goals.md; a9_runs.py says what a run is.

A run takes the pessimistic value of one constant (its variant), and the nominal values of all others. What is
compared are the cycles of a few frames; `nominal` is of the same frames.
"""

import csv
import typing

import a9_cores
import a9_moved
import a9_perception
import a9_runs
import a9_turning

# Constants that move the ring road's frame by at least 4 % (lab/a9_model/run --sensitivity all), except page_kb: the
# firmware fixes its sections.
CONSTANTS = ("window", "stores_wait_for_data", "l2_extra", "ddr_latency", "uncached_write")
FRAMES = 2
WARM_UP = 8  # of classes
FUSED = ("decode", "beams", "carve", "mark", "clear")
POINTS = ("roof_vlp16", "roof_hdl64e")
KINDS = (a9_turning.BAND + a9_turning.SHORT_LINES, a9_turning.SHORT_LINES)
# The worst frames of the page, each with what the core keeps of a line.
WORST = {"three_echoes": "kept", "random_azimuths": "forgotten"}


class Headline(typing.NamedTuple):
    """An image, its arguments and its stages; `sums` maps each name to the stages that it adds up."""

    name: str
    image: str
    arguments: tuple
    stages: dict[str, list[str]]
    outside: dict[str, list[str]]
    sums: dict[str, tuple[str, ...]]


def _frames(name: str, image: str, *arguments) -> Headline:
    stages = a9_runs.STAGES
    return Headline(name, f"frame_cost-{image}", arguments, stages, a9_runs.OUTSIDE,
                    {"fused": FUSED, "frame": tuple(stages)})


def _tree(name: str, capture: str) -> Headline:
    stages = {"tree": ["target/tree_cost:build_tree"]}
    return Headline(name, "tree_cost", (capture, FRAMES), stages, {}, {"tree": ("tree",)})


def _classes(name: str, image: str, capture: str) -> Headline:
    stages = a9_perception.STAGES
    return Headline(name, image, (capture, FRAMES, WARM_UP), stages, a9_perception.OUTSIDE,
                    {"frame": tuple(stages)})


def images() -> list[str]:
    return [f"frame_cost-{vehicle}{kind}" for vehicle in POINTS for kind in KINDS] + [
        a9_cores.image_of(drive) for drive in ("city", a9_moved.TRACKED)]


def headlines(scenes: dict[str, str], drives: dict[str, str], turns: dict[str, str]) -> list[Headline]:
    """The headlines of one core. scenes, drives and turns: captures by their names; the drives with poses."""
    found = [_frames(f"scene={scene} coding={coding}", "reference_car", capture, coding, a9_runs.ALL_SENSORS, FRAMES,
                     "kept", a9_runs.WARM_UP)
             for scene, capture in scenes.items() for coding in ("raw", "shortest")]
    road = scenes["ring_road"]
    found += [_frames("scene=ring_road paths=forgotten", "reference_car", road, "raw", a9_runs.ALL_SENSORS, FRAMES,
                      "forgotten", 1), _tree("scene=ring_road tree", road)]
    found += [_frames(f"worst={kind} paths={paths}", "reference_car", a9_runs.worst_capture(kind), "raw",
                      a9_runs.ALL_SENSORS, 1, paths, 1) for kind, paths in WORST.items()]
    found += [_frames(f"vehicle={vehicle}{kind}", vehicle + kind, turns[vehicle], "shortest", 1, 1, "kept", 1)
              for vehicle in POINTS for kind in KINDS]
    return found + [_classes(f"drive={drive}", a9_cores.image_of(drive), capture) for drive, capture in drives.items()]


def of_headline(place: a9_runs.Place, headline: Headline, variant: str, options: str) -> list[a9_runs.Row]:
    _, own = a9_runs.modelled(place, options, headline.stages | headline.outside, place.images / headline.image,
                              *headline.arguments)
    return [a9_runs.Row(f"sensitivity {headline.name}", stage, variant, "cycles",
                        str(sum(own[part]["cycles"] for part in parts)))
            for stage, parts in headline.sums.items()]


def of_four_cores(place: a9_runs.Place, drive: str, capture: str, variant: str, options: str) -> list[a9_runs.Row]:
    """Cycles without the cost of the rounds themselves (docs/results/four_cores.md)."""
    rows = a9_cores.of_drive(place, drive, options, capture, frames=FRAMES, before=WARM_UP)
    cycles = sum(row.bounded_cycles for row in rows if row.cores == max(a9_cores.CORES))
    return [a9_runs.Row(f"sensitivity drive={drive} cores=4", "frame", variant, "cycles", str(cycles))]


def runs(place: a9_runs.Place, scenes: dict[str, str], drives: dict[str, str], turns: dict[str, str]) -> list:
    table = csv.DictReader(a9_runs.output_of(place.model / "a9_constants", "--csv").splitlines())
    values = {row["constant"]: row["pessimistic"] for row in table}
    variants = {"nominal": "nominal"} | {name: f"nominal,{name}={values[name]}" for name in CONSTANTS}
    one_core = [lambda h=headline, v=variant, o=options: of_headline(place, h, v, o)
                for headline in reversed(headlines(scenes, drives, turns)) for variant, options in variants.items()]
    return [lambda d=drive, c=capture, v=variant, o=options: of_four_cores(place, d, c, v, o)
            for drive, capture in drives.items() for variant, options in variants.items()] + one_core
