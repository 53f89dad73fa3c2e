"""The runs of lab/data/cortex_a9.csv that are of units that turn; a9_runs.py says what a run is.

Whole frames are of drives of `iog simulate`, with tiles as the firmware sends them: of the car, which
follows the ground, and by its height band; with its own lines, and with those of 50 m.
"""

import a9_runs

VEHICLES = ("roof_vlp16", "roof_hdl32e", "roof_hdl64e")
BAND = "_band"        # of the image and the car that lab/target/CMakeLists.txt makes of a car
SHORT_LINES = "_50m"  # the same
WARM_UP = 2
FRAMES = 1


def drive(vehicle: str) -> str:
    return f"simulate --vehicle {vehicle} --seed 1 --seconds 1"


def counted(place: a9_runs.Place, vehicle: str, capture: str) -> list[a9_runs.Row]:
    """Fails if a grid is not that of `iog fuse`."""
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


def images() -> list[str]:
    return [vehicle + heights + lines for vehicle in VEHICLES for heights in ("", BAND)
            for lines in ("", SHORT_LINES)]


def _of_images(place: a9_runs.Place, captures: dict[str, str], run) -> list:
    return [lambda v=vehicle: run(place, v, captures[v.removesuffix(SHORT_LINES).removesuffix(BAND)])
            for vehicle in images()]


def counted_runs(place: a9_runs.Place, captures: dict[str, str]) -> list:
    return _of_images(place, captures, counted)


def modelled_runs(place: a9_runs.Place, captures: dict[str, str]) -> list:
    return _of_images(place, captures, modelled)
