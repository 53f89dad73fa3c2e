"""What drawing the map's tiles takes while a car drives at 30 m/s: by the cost model, beside the
goals."""

from claims import Goal
from cortex_a9 import CortexA9
from markdown import fixed, grouped
from section import Section

MAPS = {"city": "simulated city", "dense_town": "dense town"}
VARIANTS = ("nominal", "pessimistic")
GOAL_CYCLES = 30_000  # a tile
GOAL_TILES = 12       # a frame
LAYER = "layer"


def run_of(name):
    return f"map_cost map={name}"


def untimed(a9, name):
    """The share of the counted instructions that the model does not time."""
    timed = a9.value(run_of(name), "instructions", LAYER, "nominal")
    return 1 - timed / a9.value(run_of(name), "instructions", LAYER)


def cycles_of(a9, name, variant, counter="cycles"):
    """What is not timed is taken for as fast as the rest."""
    return a9.value(run_of(name), counter, LAYER, variant) / (1 - untimed(a9, name))


def cycles_per_tile(a9, name, variant):
    return cycles_of(a9, name, variant) / a9.value(run_of(name), "tiles")


def count_row(a9, name):
    run = run_of(name)
    return [MAPS[name], fixed(a9.mean(run, "tiles"), 1), grouped(a9.value(run, "most_tiles")),
            grouped(a9.value(run, "most_waiting")), grouped(a9.mean(run, "instructions", LAYER)),
            grouped(a9.value(run, "instructions_max", LAYER)),
            *(fixed(cycles_of(a9, name, variant, "cycles_max") / 1e6, 2) for variant in VARIANTS)]


def goals(a9):
    found = []
    for name, words in MAPS.items():
        for variant in VARIANTS:
            cycles = cycles_per_tile(a9, name, variant)
            found.append(Goal(f"map of the {words}: cycles a tile, {variant}",
                              f"≤ {grouped(GOAL_CYCLES)}", grouped(cycles), cycles <= GOAL_CYCLES))
    mean, most = a9.mean(run_of("city"), "tiles"), a9.value(run_of("city"), "most_tiles")
    found.append(Goal(f"map of the {MAPS['city']}: tiles of a mean frame", f"≤ {GOAL_TILES}",
                      fixed(mean, 1), mean <= GOAL_TILES))
    found.append(Goal(f"map of the {MAPS['city']}: tiles of the frame with the most",
                      f"≤ {GOAL_TILES}", grouped(most), most <= GOAL_TILES))
    return found


def section(data):
    a9 = CortexA9(data)
    return Section({
        "frames": int(a9.value(run_of("city"), "frames")),
        "radius": int(a9.value(run_of("city"), "radius")),
        "counts": [count_row(a9, name) for name in MAPS],
        "dearest_ms": {name: fixed(cycles_of(a9, name, "nominal", "cycles_max") / 1e6, 2) for name in MAPS},
        "is_untimed": untimed(a9, "dense_town") > 0.001,
        "untimed": {name: untimed(a9, name) for name in MAPS},
        "town_waits": (a9.value(run_of("dense_town"), "most_waiting") >
                       a9.value(run_of("city"), "most_waiting")),
        "is_town_within": cycles_per_tile(a9, "dense_town", "nominal") <= GOAL_CYCLES,
        "is_burst": a9.value(run_of("city"), "most_tiles") > GOAL_TILES,
        "layer_bytes": grouped(a9.value(run_of("city"), "layer_bytes")),
    }, goals=goals(a9))
