"""The runs of lab/target/cortex_a9.txt: which there are, and how each is measured.

A run is one image of the benchmark in QEMU. It gives one or more lines of key=value pairs: of
instructions, which QEMU counts, or of what the cost model of docs/a9_model.md says; those begin with
"model". lab/target/measure_a9 makes all of them, tests/e2e/a9_figures some.
"""

import concurrent.futures
import dataclasses
import pathlib
import re
import subprocess

HERE = pathlib.Path(__file__).resolve().parent

# A frame is taken apart at functions of the core: an instruction belongs to the innermost of these
# that it is called from, so that the stages add up to the frame. Two lie outside it: what the
# benchmark itself does between two frames, and reading its stopwatch.
STAGES = {
    "receive": ["iog::net::parse_ethernet(", "iog::net::parse_ipv4(", "iog::net::parse_udp("],
    "decode": ["iog::app::FrameEngine::inspect("],
    "beams": ["iog::app::FrameEngine::fuse("],
    "carve": ["iog::grid::carve_blocks(", "iog::grid::carve_cells("],
    "mark": ["iog::grid::FrameFusion::finish("],
    "encode": ["iog::lab::StagePass::take(", "iog::lab::StagePass::tick("],
    "send": ["iog::net::build_message("],
    "clear": ["iog::grid::BlockGrid::clear_tile("],
}
OUTSIDE = {
    "benchmark": ["iog::lab::StagePass::add_end("],
    "stopwatch": ["iog::lab::InstructionCounter::now("],
}
PASSES = {name: [f"iog::lab::(anonymous namespace)::Passes::{name}("]
          for name in ("fuse", "send", "clear")}
COUNTERS = ("instructions", "cycles", "l1d_refills", "l2_misses", "mispredicts")
VARIANTS = ("nominal", "optimistic", "pessimistic")

# The model takes its time: so many frames, after some to warm up, in which most lines are found that
# are kept from then on. What more of them would change is measured, too: the long run is that of
# four LUX, nominal.
WARM_UP = 6
MODELLED_FRAMES = 8
LONG_FRAMES = 32
FORGOTTEN_FRAMES = 3
WORST_FRAMES = 2
SCALING_FRAMES = 2
FEW_FRAMES = 2


@dataclasses.dataclass(frozen=True)
class Place:
    """Where things are. The images see captures by a name in `work`, which has no blanks."""

    iog: pathlib.Path
    images: pathlib.Path
    model: pathlib.Path
    work: pathlib.Path

    @property
    def worst_frames(self) -> pathlib.Path:
        return self.iog.parents[1] / "lab/scenarios/worst_frames"


def output_of(*words, cwd=None) -> str:
    return subprocess.run([str(word) for word in words], cwd=cwd, text=True, check=True,
                          stdout=subprocess.PIPE).stdout


def counted(place: Place, image: str, *arguments) -> str:
    return output_of(HERE / "run_image", place.images / image, *arguments, cwd=place.work)


def pairs_of(line: str) -> dict[str, str]:
    return dict(word.split("=", 1) for word in line.split() if "=" in word)


def modelled(place: Place, variant: str, functions: dict[str, list[str]], image: pathlib.Path,
             *arguments) -> tuple[str, dict[str, dict[str, int]]]:
    """What the image printed, and what the model says of its functions without one another."""
    first, *others = arguments or [""]
    options = [word for other in others for word in ("--argument", other)]
    options += [word for name, symbols in functions.items() for symbol in symbols
                for word in ("--function", f"{name}={symbol}")]
    printed = output_of(HERE.parent / "a9_model/run", image, first, *options,
                        "--build", place.model, "--lines", variant, cwd=place.work)
    own = {name: dict.fromkeys(COUNTERS, 0) for name in functions}
    head = []
    for line in printed.splitlines():
        pairs = pairs_of(line)
        if not line.startswith("modelled "):
            head.append(line)
        elif "self" in pairs:
            for key in COUNTERS:
                own[pairs["self"]][key] += int(pairs[key])
    return "\n".join(head), own


def line_of(name: str, stages: dict[str, dict[str, int]]) -> str:
    return " ".join([name, *(f"{stage}_{key}={sums[key]}"
                             for key in COUNTERS for stage, sums in stages.items())]) + "\n"


def with_whole(stages: dict[str, dict[str, int]], whole: str) -> dict[str, dict[str, int]]:
    return {**stages, whole: {key: sum(sums[key] for sums in stages.values()) for key in COUNTERS}}


def frame(place: Place, name: str, variant: str, capture: str, sensors: int, frames: int,
          paths: str = "kept", before: int = 1, coding: str = "raw") -> str:
    """A mean frame, stage by stage."""
    _, own = modelled(place, variant, STAGES | OUTSIDE,
                      place.images / "frame_cost-reference_car", capture, coding, sensors, frames,
                      paths, before)
    naming = "" if paths == "kept" else f" paths={paths}"
    naming += "" if coding == "raw" else f" coding={coding}"
    return line_of(f"{name} sensors={sensors}{naming} variant={variant} frames={frames} "
                   f"before={before}",
                   with_whole({stage: own[stage] for stage in STAGES}, "frame"))


def floor(place: Place, name: str, capture: str, frames: int) -> str:
    head, own = modelled(place, "nominal", PASSES, place.images / "floor", capture, frames)
    lines = pairs_of(head)["lines"]
    return line_of(f"{name} variant=nominal frames={frames} lines={lines}", own)


def tree(place: Place, name: str, variant: str, capture: str, frames: int) -> str:
    """The linear quadtree of a mean frame."""
    head, own = modelled(place, variant,
                         {"tree": ["iog::lab::(anonymous namespace)::build_tree("]},
                         place.images / "tree_cost", capture, frames)
    counts = pairs_of(head)
    return line_of(f"{name} variant={variant} frames={frames} leaves={counts['leaves']} "
                   f"bytes={counts['bytes']}", own)


WALKS = {"discrete r=20": "DiscreteWalk<20l>", "discrete r=100": "DiscreteWalk<100l>",
         "discrete r=200": "DiscreteWalk<200l>", "discrete r=1024": "DiscreteWalk<1024l>",
         "continuous_float": "ContinuousWalk<float>", "continuous_double": "ContinuousWalk<double>",
         "float_error": "RealErrorWalk<float>", "bresenham": "BresenhamWalk"}


def symbol_of_walk(name: str) -> str:
    """The first lambda of measure() carves, the second counts."""
    nested = name.replace(">", "> ") if name.endswith(">") else name
    return (f"void iog::lab::(anonymous namespace)::run<iog::lab::{name}, "
            f"iog::lab::(anonymous namespace)::measure<iog::lab::{nested}>"
            "(iog::lab::InstructionCounter&, char const*)::{lambda(unsigned int)#1}>")


def walks(place: Place, variant: str) -> str:
    symbols = {walk.replace(" ", "_").replace("=", ""): [symbol_of_walk(name)]
               for walk, name in WALKS.items()}
    _, own = modelled(place, variant, symbols, place.images / "traversal_cost")
    return "".join(
        " ".join([f"model traversal_cost walk={walk} variant={variant}",
                  *(f"{key}={sums[key]}" for key in COUNTERS)]) + "\n"
        for walk, sums in zip(WALKS, own.values()))


def scaling(place: Place, image: pathlib.Path, sensors: int, azimuths: int, range_cm: int) -> str:
    stages = {stage: STAGES[stage] for stage in STAGES if stage != "receive"}
    head, own = modelled(place, "nominal", stages | OUTSIDE, image, sensors, azimuths, range_cm,
                         SCALING_FRAMES)
    sums = {stage: own[stage] for stage in stages}
    load, counts = re.fullmatch(r"(scaling .* range_cm=\d+) (.*)", head.strip()).groups()
    return line_of(f"model {load} variant=nominal {counts}", with_whole(sums, "frame"))


# Base point of the scaling: four LUX of 201 directions that see something 25 m away, on the default
# grid. One thing at a time is changed; another grid is another build.
SCALING_BASE = (4, 201, 2500)
SCALING_GRIDS = {  # (cells per side, mm): (sensors, directions, range in cm) ...
    (1024, 100): [SCALING_BASE,
                  *((sensors, 201, 2500) for sensors in (1, 2, 3, 5, 6, 7, 8)),
                  *((4, azimuths, 2500) for azimuths in (51, 101, 401, 801)),
                  *((4, 201, range_cm) for range_cm in (625, 1250, 3750, 5000))],
    (512, 100): [SCALING_BASE],
    (2048, 100): [SCALING_BASE, (4, 201, 5000), (4, 201, 10_000)],
    (4096, 100): [SCALING_BASE, (4, 201, 5000), (4, 201, 10_000)],
    (512, 200): [SCALING_BASE, (4, 201, 5000)],
    (2048, 50): [SCALING_BASE, (4, 201, 5000)],
}


def grid_folder(place: Place, grid: tuple[int, int]) -> pathlib.Path:
    cells, cell_mm = grid
    return place.images if grid == (1024, 100) else place.work / f"grid_{cells}_{cell_mm}/lab/target"


NAMES = {"city": "", "ring_road": " scene=ring_road"}
# Grids that follow each other, for the serial line.
SERIAL_FRAMES = range(40, 44)


def frame_cost(place: Place, name: str, capture: str, coding: str, *sensors: int) -> str:
    line = counted(place, "frame_cost-reference_car", capture, coding, *sensors)
    return line.replace("frame_cost ", f"frame_cost{name} ", 1)


def serial_cost(place: Place, scene: str, capture: str) -> str:
    """What the serial line costs and carries of a scene."""
    grids = []
    for number in SERIAL_FRAMES:
        grids.append(f"{scene}_{number}")
        output_of(place.iog, "fuse", "--pcap", place.work / capture, "--frame", number,
                  "--out-raw", place.work / grids[-1])
    return counted(place, "serial_cost", *grids).replace(
        "serial_cost ", f"serial_cost scene={scene} ")


# What measures a line or some, without arguments.
def counted_runs(place: Place, scenes: dict[str, str], ring_road_sensors=(2, 3, 4)) -> list:
    runs = []
    for scene, numbers in (("city", (2, 3, 4)), ("ring_road", ring_road_sensors)):
        for sensors in numbers:
            runs.append(lambda s=scene, n=sensors: frame_cost(
                place, NAMES[s], scenes[s], "raw", n))
    for scene, capture in scenes.items():
        runs.append(lambda s=scene, c=capture: frame_cost(
            place, f"{NAMES[s]} coding=shortest", c, "shortest"))
    runs += [lambda s=scene, c=capture: serial_cost(place, s, c)
             for scene, capture in scenes.items()]
    runs.append(lambda: counted(place, "traversal_cost"))
    runs.append(lambda: counted(place, "many_core", scenes["city"]))
    return runs


def worst_names(place: Place) -> list[str]:
    return output_of(place.worst_frames, "--names").split()


def worst_capture(place: Place, name: str) -> str:
    capture = f"worst_{name}.pcap"
    output_of(place.worst_frames, "--name", name, "--out", place.work / capture)
    return capture


def worst_run(place: Place, name: str) -> str:
    """Fails if a grid is not that of `iog fuse`."""
    capture = worst_capture(place, name)
    line = frame_cost(place, f" worst={name}", capture, "raw")
    check_grids(place, line, capture)
    return line


def check_grids(place: Place, line: str, capture: str) -> None:
    report = output_of(place.iog, "fuse", "--pcap", place.work / capture,
                       "--vehicle", "reference_car")
    expected = re.search(r"^run hash +(\w+)$", report, re.M).group(1)
    found = pairs_of(line)["run_hash"]
    assert found == expected, f"{capture}: its grids {found} are not those of iog fuse, {expected}"


def modelled_runs(place: Place, scenes: dict[str, str], worst: list[str]) -> list:
    runs = []
    for variant in VARIANTS:
        for scene, capture in scenes.items():
            name = f"model frame_cost{NAMES[scene]}"
            for sensors in (2, 3, 4):
                runs.append(lambda n=name, v=variant, c=capture, s=sensors: frame(
                    place, n, v, c, s, MODELLED_FRAMES, before=WARM_UP))
            runs.append(lambda n=name, v=variant, c=capture: frame(
                place, n, v, c, 4, FORGOTTEN_FRAMES, "forgotten"))
            runs.append(lambda n=name, v=variant, c=capture: frame(
                place, n, v, c, 4, MODELLED_FRAMES, before=WARM_UP, coding="shortest"))
            runs.append(lambda n=NAMES[scene], v=variant, c=capture: tree(
                place, f"model tree{n}", v, c, MODELLED_FRAMES))
        for kind in worst:
            for paths, frames in (("kept", WORST_FRAMES), ("forgotten", 1)):
                runs.append(lambda k=kind, v=variant, n=frames, p=paths: frame(
                    place, f"model frame_cost worst={k}", v, f"worst_{k}.pcap", 4, n, p))
        runs.append(lambda v=variant: walks(place, v))
    for kind in worst:
        runs.append(lambda k=kind: floor(
            place, f"model floor worst={k}", f"worst_{k}.pcap", WORST_FRAMES))
    for scene, capture in scenes.items():
        runs.append(lambda n=NAMES[scene], c=capture: frame(
            place, f"model long_run{n}", "nominal", c, 4, LONG_FRAMES, before=WARM_UP))
        runs.append(lambda n=NAMES[scene], c=capture: floor(
            place, f"model floor{n}", c, MODELLED_FRAMES))
    runs.append(lambda: few_frames(place, scenes))
    for grid, points in SCALING_GRIDS.items():
        for point in points:
            runs.append(lambda g=grid, p=point: scaling(
                place, grid_folder(place, g) / "scaling", *p))
    return runs


def few_frames(place: Place, scenes: dict[str, str]) -> str:
    """What tests/e2e/a9_figures has the time to repeat."""
    return frame(place, "model first_frames scene=ring_road", "nominal", scenes["ring_road"], 4,
                 FEW_FRAMES)


def results_of(runs: list, processors: int = 2) -> str:
    """Their lines in the order of the runs, so many at a time."""
    with concurrent.futures.ThreadPoolExecutor(processors) as pool:
        return "".join(pool.map(lambda run: run(), runs))
