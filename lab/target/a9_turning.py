"""The runs of lab/data/cortex_a9.csv that are of units that turn; a9_runs.py says what a run is.

Whole frames are of drives of `iog simulate`, with tiles as the firmware sends them: of the car, which
follows the ground, and by its height band; with its own lines, and with those of 50 m. Frames of
turning_cost are made up: no wire format, no stream, ranges of 5 to 50 m at random.
"""

import a9_runs

VEHICLES = ("roof_vlp16", "roof_hdl32e", "roof_hdl64e")
BAND = "_band"        # of the image and the car that lab/target/CMakeLists.txt makes of a car
SHORT_LINES = "_50m"  # the same
WARM_UP = 2
FRAMES = 1
# Layers, azimuths, way of firing, height band.
MADE_UP = [("16", "1808", "spread", "car"), ("32", "2170", "spread", "car"),
           ("64", "2048", "column", "car"), ("64", "2048", "column", "open")]
REGIONS = {"1": "fuse", "2": "mark"}


def drive(vehicle: str) -> str:
    return f"simulate --vehicle {vehicle} --seed 1 --seconds 1"


def counted(place: a9_runs.Place, vehicle: str, capture: str) -> list[a9_runs.Row]:
    """Fails if a grid is not that of `iog fuse`."""
    car = vehicle
    if vehicle not in VEHICLES:
        car = str(place.images / f"vehicles/{vehicle}.toml")
    line, = a9_runs.counted(place, f"frame_cost-{vehicle}", capture, "shortest", 1, "stages")
    rows = a9_runs.counted_rows(line, f"turning vehicle={vehicle}")
    a9_runs.check_grids(place, rows, capture, car)
    return rows


def modelled(place: a9_runs.Place, vehicle: str, capture: str) -> list[a9_runs.Row]:
    """A mean frame, stage by stage."""
    stages = a9_runs.STAGES
    _, own = a9_runs.modelled(place, "nominal", stages | a9_runs.OUTSIDE,
                              place.images / f"frame_cost-{vehicle}", capture, "shortest", 1, FRAMES,
                              "kept", WARM_UP)
    return a9_runs.modelled_rows(f"turning vehicle={vehicle}", "nominal", {"frames": FRAMES},
                                 a9_runs.with_whole({stage: own[stage] for stage in stages}, "frame"))


def made_up_run(made_up: tuple[str, ...]) -> str:
    names = ("layers", "azimuths", "pattern", "band")
    return " ".join(["turning_cost", *(f"{name}={value}" for name, value in zip(names, made_up))])


def made_up_counted(place: a9_runs.Place, made_up: tuple[str, ...]) -> list[a9_runs.Row]:
    line, = a9_runs.counted(place, "turning_cost", *made_up, FRAMES)
    return [a9_runs.Row(made_up_run(made_up), stage, "counted", "instructions" if stage else name, value)
            for name, value in a9_runs.pairs_of(line).items() if name not in ("layers", "azimuths")
            for stage in [name if name in REGIONS.values() else ""] if name != "instructions_a_point"]


def made_up_modelled(place: a9_runs.Place, made_up: tuple[str, ...]) -> list[a9_runs.Row]:
    stages = a9_runs.regions(a9_runs.printed_by_model(
        place, "nominal", {}, place.images / "turning_cost", *made_up, FRAMES), REGIONS)
    return a9_runs.modelled_rows(made_up_run(made_up), "nominal", {"frames": FRAMES},
                                 a9_runs.with_whole(stages, "frame"))


def images() -> list[str]:
    return [vehicle + heights + lines for vehicle in VEHICLES for heights in ("", BAND)
            for lines in ("", SHORT_LINES)]


def _of_images(place: a9_runs.Place, captures: dict[str, str], run) -> list:
    return [lambda v=vehicle: run(place, v, captures[v.removesuffix(SHORT_LINES).removesuffix(BAND)])
            for vehicle in images()]


def counted_runs(place: a9_runs.Place, captures: dict[str, str]) -> list:
    return (_of_images(place, captures, counted) +
            [lambda m=made_up: made_up_counted(place, m) for made_up in MADE_UP])


def modelled_runs(place: a9_runs.Place, captures: dict[str, str]) -> list:
    return (_of_images(place, captures, modelled) +
            [lambda m=made_up: made_up_modelled(place, m) for made_up in MADE_UP])
