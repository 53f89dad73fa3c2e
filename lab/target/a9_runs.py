"""The runs of lab/data/cortex_a9.csv: which there are, and how each is measured.

A run is one image of the benchmark in QEMU. It gives rows: of instructions, which QEMU counts, or of
what the cost model of docs/a9_model.md says. lab/target/measure_a9 makes all of them, lab/check some.
Runs of frames with classes are in a9_perception.py, those of the map's layer in a9_map.py, those of
units that turn in a9_turning.py, those with classes of them in a9_moved.py, those of growing loads in a9_scaling.py,
those of other constants of the model in a9_sensitivity.py.
"""

import concurrent.futures
import dataclasses
import os
import pathlib
import re
import subprocess
import typing

HERE = pathlib.Path(__file__).resolve().parent

# What is measured together, by the first words of the runs' names, in the order of the table.
PARTS = {
    "frames": ("frame_cost", "traversal_cost", "path_cost", "many_core",
               "printed_cost", "tree", "floor"),
    "scaling": ("scaling",),
    "perception": ("perception_cost", "object_cost"),
    "map": ("map_cost",),
    "turning": ("turning",),
    "moved": ("moved_cost",),
    "sensitivity": ("sensitivity",),
}


def part_of(run: str) -> str:
    return next(part for part, words in PARTS.items() if run.split(" ", 1)[0] in words)


# A frame is taken apart by functions of the core: an instruction belongs to the innermost of these in
# which it lies or from which it is called, so that the stages add up to the frame. A function is named
# by the end of its file's path, without an extension, wherever the compiler has put what it does
# (lab/a9_model/stage_map.hpp). Two stages lie outside the frame: what the benchmark itself does between
# two frames, and reading its stopwatch.
STAGES = {
    "receive": ["ethernet/port_functions:receive", "net/ethernet:parse_ethernet", "net/ipv4:parse_ipv4",
                "net/udp:parse_udp"],
    "decode": ["intake/intake:receive", "intake/intake:classify", "app/frame:accept"],
    "beams": ["fusion/shared_fusion:add_points"],
    "carve": ["grid/carving:carve_blocks", "grid/carving:carve_cells"],
    "mark": ["fusion/frame_fusion:finish"],
    "encode": ["target/stage_pass:take", "target/stage_pass:tick"],
    "send": ["net/outbound:build_datagram",
             *(f"ethernet/port_functions:{name}" for name in ("acquire", "commit", "pump"))],
    "clear": ["grid/block_grid:clear_tile"],
}
OUTSIDE = {"benchmark": ["target/stage_pass:add_end"],
           "stopwatch": ["target/instruction_counter:now"]}
PASSES = {name: [f"target/floor:{name}"] for name in ("fuse", "send", "clear")}
COUNTERS = ("instructions", "cycles", "l1d_refills", "l2_misses", "mispredicts")
VARIANTS = ("nominal", "optimistic", "pessimistic")

# The model takes its time: so many frames, after some to warm up, in which most lines are found that
# are kept from then on.
WARM_UP = 6
MODELLED_FRAMES = 8
FORGOTTEN_FRAMES = 3
WORST_FRAMES = 2


class Row(typing.NamedTuple):
    """One value; lab/pages/cortex_a9.py says what the keys mean."""

    run: str
    stage: str
    variant: str
    counter: str
    value: str


@dataclasses.dataclass(frozen=True)
class Place:
    """Where things are. The images see captures by a name in `work`, which has no blanks."""

    iog: pathlib.Path
    images: pathlib.Path
    model: pathlib.Path
    work: pathlib.Path
    plain: bool = False  # without what makes counting faster

    @property
    def worst_frames(self) -> pathlib.Path:
        return self.iog.parents[1] / "lab/scenarios/worst_frames"


def output_of(*words, cwd=None) -> str:
    return subprocess.run([str(word) for word in words], cwd=cwd, text=True, check=True,
                          stdout=subprocess.PIPE).stdout


def counted(place: Place, image: str, *arguments) -> list[str]:
    """The lines that the image prints."""
    plain = ["--plain"] if place.plain else []
    return output_of(HERE / "run_image", *plain, place.images / image, *arguments,
                     cwd=place.work).splitlines()


def pairs_of(line: str) -> dict[str, str]:
    return dict(word.split("=", 1) for word in line.split() if "=" in word)


# What an image prints to say which run its line is of.
NAMING = {"frame_cost": ("sensors",), "traversal_cost": ("walk", "r"),
          "many_core": ("approach", "cell_mm"), "perception_cost": (), "object_cost": ("kind",), "map_cost": (),
          "printed_cost": ("extent",), "path_cost": (),
          "scaling": ("cells_per_side", "cell_mm", "sensors", "azimuths", "range_cm")}
# fuse_sum, fuse_min, fuse_max: of a stage over its frames. A mean follows from the sum.
OF_FRAMES = re.compile(r"(\w+)_(sum|min|max)")
OF_STAGE = re.compile(r"(\w+)_instructions")


def run_of(line: str) -> str:
    """traversal_cost walk=discrete r=20"""
    image = line.split(" ", 1)[0]
    pairs = pairs_of(line)
    return " ".join([image, *(f"{key}={pairs[key]}" for key in NAMING[image] if key in pairs)])


def key_of(name: str) -> tuple[str, str]:
    """The stage and the counter that an image calls by one word."""
    if match := OF_FRAMES.fullmatch(name):
        kind = "" if match[2] == "sum" else f"_{match[2]}"
        return match[1], f"instructions{kind}"
    if match := OF_STAGE.fullmatch(name):
        return match[1], "instructions"
    return "", name


def counted_rows(line: str, run: str) -> list[Row]:
    """Of a line that an image has printed."""
    naming = NAMING[line.split(" ", 1)[0]]
    rows = []
    for name, value in pairs_of(line).items():
        if name not in naming and not name.endswith("_mean"):
            stage, counter = key_of(name)
            rows.append(Row(run, stage, "counted", counter, value))
    return rows


def printed_by_model(place: Place, variant: str, stages: dict[str, list[str]],
                     image: pathlib.Path, *arguments) -> list[str]:
    first, *others = arguments or [""]
    options = [word for other in others for word in ("--argument", other)]
    options += [word for name, functions in stages.items() for function in functions
                for word in ("--stage", f"{name}={function}")]
    return output_of(HERE.parent / "a9_model/run", image, first, *options, "--build", place.model,
                     "--lines", variant, cwd=place.work).splitlines()


def modelled(place: Place, variant: str, stages: dict[str, list[str]], image: pathlib.Path,
             *arguments) -> tuple[dict[str, str], dict[str, dict[str, int]]]:
    """The pairs that the image printed, and what the model says of its stages."""
    return own_of(printed_by_model(place, variant, stages, image, *arguments), stages)


def own_of(printed: list[str], stages: dict[str, list[str]]):
    own = {name: dict.fromkeys(COUNTERS, 0) for name in stages}
    head = {}
    for line in printed:
        pairs = pairs_of(line)
        if not line.startswith("modelled "):
            head.update(pairs)
        elif "self" in pairs:
            for key in COUNTERS:
                own[pairs["self"]][key] += int(pairs[key])
    return head, own


def modelled_rows(run: str, variant: str, counts: dict[str, typing.Any],
                  stages: dict[str, dict[str, int]]) -> list[Row]:
    return ([Row(run, "", variant, counter, str(value)) for counter, value in counts.items()] +
            [Row(run, stage, variant, counter, str(sums[counter]))
             for counter in COUNTERS for stage, sums in stages.items()])


def with_whole(stages: dict[str, dict[str, int]], whole: str) -> dict[str, dict[str, int]]:
    return {**stages, whole: {key: sum(sums[key] for sums in stages.values()) for key in COUNTERS}}


def frame(place: Place, name: str, variant: str, capture: str, sensors: int, frames: int,
          paths: str = "kept", before: int = 1, coding: str = "raw") -> list[Row]:
    """A mean frame, stage by stage."""
    _, own = modelled(place, variant, STAGES | OUTSIDE,
                      place.images / "frame_cost-reference_car", capture, coding, sensors, frames,
                      paths, before)
    run = f"{name} sensors={sensors}"
    run += "" if paths == "kept" else f" paths={paths}"
    run += "" if coding == "raw" else f" coding={coding}"
    return modelled_rows(run, variant, {"frames": frames, "before": before},
                         with_whole({stage: own[stage] for stage in STAGES}, "frame"))


def floor(place: Place, run: str, capture: str, frames: int) -> list[Row]:
    head, own = modelled(place, "nominal", PASSES, place.images / "floor", capture, frames)
    return modelled_rows(run, "nominal", {"frames": frames, "lines": head["lines"]}, own)


def tree(place: Place, run: str, variant: str, capture: str, frames: int) -> list[Row]:
    """The linear quadtree of a mean frame."""
    head, own = modelled(place, variant,
                         {"tree": ["target/tree_cost:build_tree"]},
                         place.images / "tree_cost", capture, frames)
    return modelled_rows(run, variant, {"frames": frames, "leaves": head["leaves"],
                                        "bytes": head["bytes"]}, own)


# The regions of traversal_cost, by their numbers from 1 on.
WALKS = ("discrete r=20", "discrete r=100", "discrete r=200", "discrete r=1024", "continuous_float",
         "continuous_double", "float_error", "bresenham")


def regions(printed: list[str], names: dict[str, str]) -> dict[str, dict[str, int]]:
    """What the model says of marked regions, which have names here."""
    return {names[pairs["region"]]: {key: int(pairs[key]) for key in COUNTERS}
            for pairs in map(pairs_of, printed) if pairs.get("region") in names}


def walks(place: Place, variant: str) -> list[Row]:
    names = {str(number): walk for number, walk in enumerate(WALKS, 1)}
    found = regions(printed_by_model(place, variant, {}, place.images / "traversal_cost"), names)
    return [row for walk in WALKS
            for row in modelled_rows(f"traversal_cost walk={walk}", variant, {}, {"": found[walk]})]


ALL_SENSORS = 4


def frame_cost(place: Place, name: str, capture: str, coding: str, sensors: int) -> list[Row]:
    line, = counted(place, "frame_cost-reference_car", capture, coding, sensors)
    run = f"frame_cost {name} sensors={sensors}"
    return counted_rows(line, run if coding == "raw" else f"{run} coding={coding}")


def named_by_itself(place: Place, image: str, *arguments) -> list[Row]:
    return [row for line in counted(place, image, *arguments)
            for row in counted_rows(line, run_of(line))]


def printed_cost(place: Place, scene: str, capture: str) -> list[Row]:
    """What the thesis's fusion costs as it is printed."""
    return [row for line in counted(place, "printed_cost", capture)
            for row in counted_rows(line, run_of(line).replace(" ", f" scene={scene} ", 1))]


# What measures rows, without arguments.
def counted_runs(place: Place, scenes: dict[str, str], ring_road_sensors=(2, 3, 4)) -> list:
    runs = []
    for scene, numbers in (("city", (2, 3, 4)), ("ring_road", ring_road_sensors)):
        for sensors in numbers:
            runs.append(lambda s=scene, n=sensors: frame_cost(
                place, f"scene={s}", scenes[s], "raw", n))
    for scene, capture in scenes.items():
        runs.append(lambda s=scene, c=capture: frame_cost(
            place, f"scene={s}", c, "shortest", ALL_SENSORS))
    runs.append(lambda: named_by_itself(place, "traversal_cost"))
    runs.append(lambda: named_by_itself(place, "path_cost"))
    runs.append(lambda: named_by_itself(place, "many_core", scenes["city"]))
    runs.append(lambda: printed_cost(place, "ring_road", scenes["ring_road"]))
    return runs


def worst_names(place: Place) -> list[str]:
    return output_of(place.worst_frames, "--names").split()


def worst_capture(name: str) -> str:
    return f"worst_{name}.pcap"


def make_worst(place: Place, *options: str, prefix: str = "") -> list[str]:
    """Their captures; returns their names."""
    names = worst_names(place)
    for name in names:
        output_of(place.worst_frames, "--name", name, "--out", place.work / (prefix + worst_capture(name)), *options)
    return names


def worst_run(place: Place, name: str) -> list[Row]:
    """Fails if a grid is not that of `iog fuse`; of make_worst()."""
    capture = worst_capture(name)
    rows = frame_cost(place, f"worst={name}", capture, "raw", ALL_SENSORS)
    check_grids(place, rows, capture)
    return rows


def check_grids(place: Place, rows: list[Row], capture: str,
                vehicle: str = "reference_car") -> None:
    option = "--vehicle-file" if vehicle.endswith(".toml") else "--vehicle"
    report = output_of(place.iog, "fuse", "--pcap", place.work / capture, option, vehicle)
    expected = re.search(r"^run hash +(\w+)$", report, re.M).group(1)
    found = next(row.value for row in rows if row.counter == "run_hash")
    if found != expected:
        raise SystemExit(f"{rows[0].run}: its grids {found} are not those of iog fuse, {expected}")


def modelled_runs(place: Place, scenes: dict[str, str], worst: list[str]) -> list:
    runs = []
    for variant in VARIANTS:
        for scene, capture in scenes.items():
            runs += runs_of_scene(place, variant, scene, capture)
        for kind in worst:
            for paths, frames in (("kept", WORST_FRAMES), ("forgotten", 1)):
                runs.append(lambda k=kind, v=variant, n=frames, p=paths: frame(
                    place, f"frame_cost worst={k}", v, worst_capture(k), ALL_SENSORS, n, p))
        runs.append(lambda v=variant: walks(place, v))
    for kind in worst:
        runs.append(lambda k=kind: floor(
            place, f"floor worst={k}", worst_capture(k), WORST_FRAMES))
    for scene, capture in scenes.items():
        runs.append(lambda s=scene, c=capture: floor(
            place, f"floor scene={s}", c, MODELLED_FRAMES))
    return runs


def runs_of_scene(place: Place, variant: str, scene: str, capture: str) -> list:
    """A drive with two to four LUX, without kept lines, sent in the shortest form, and its tree."""
    def run(sensors, frames, **options):
        return lambda: frame(place, f"frame_cost scene={scene}", variant, capture, sensors, frames,
                             **options)
    runs = [run(sensors, MODELLED_FRAMES, before=WARM_UP) for sensors in (2, 3, ALL_SENSORS)]
    runs.append(run(ALL_SENSORS, FORGOTTEN_FRAMES, paths="forgotten"))
    runs.append(run(ALL_SENSORS, MODELLED_FRAMES, before=WARM_UP, coding="shortest"))
    runs.append(lambda: tree(place, f"tree scene={scene}", variant, capture, MODELLED_FRAMES))
    return runs


def results_of(parts: dict[str, list]) -> dict[str, list]:
    """Of each part the rows in the order of its runs. As many at a time as the PC has processors,
    begun in the order of the parts: the longest first, so that none is left alone at the end."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = {name: [pool.submit(run) for run in runs] for name, runs in parts.items()}
        try:
            return {name: [row for run in runs for row in run.result()]
                    for name, runs in found.items()}
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
