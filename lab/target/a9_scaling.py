"""The runs of lab/data/cortex_a9.csv that are of loads that grow; a9_runs.py says what a run is."""

import pathlib

import a9_runs

FRAMES = 2


def scaling(place: a9_runs.Place, image: pathlib.Path, sensors: int, azimuths: int,
            range_cm: int) -> list[a9_runs.Row]:
    stages = {stage: a9_runs.STAGES[stage] for stage in a9_runs.STAGES if stage != "receive"}
    head, own = a9_runs.modelled(place, "nominal", stages | a9_runs.OUTSIDE, image, sensors, azimuths,
                                 range_cm, FRAMES)
    naming = {key: head.pop(key) for key in a9_runs.NAMING["scaling"]}
    run = " ".join(["scaling", *(f"{key}={value}" for key, value in naming.items())])
    return a9_runs.modelled_rows(
        run, "nominal", head, a9_runs.with_whole({stage: own[stage] for stage in stages}, "frame"))


# Base point of the scaling: four LUX of 201 directions that see something 25 m away, on the default
# grid. One thing at a time is changed; another grid is another build.
BASE = (4, 201, 2500)
GRIDS = {  # (cells per side, mm): (sensors, directions, range in cm) ...
    (1024, 100): [BASE,
                  *((sensors, 201, 2500) for sensors in (1, 2, 3, 5, 6, 7, 8)),
                  *((4, azimuths, 2500) for azimuths in (51, 101, 401, 801)),
                  *((4, 201, range_cm) for range_cm in (625, 1250, 3750, 5000))],
    (512, 100): [BASE],
    (2048, 100): [BASE, (4, 201, 5000), (4, 201, 10_000)],
    (4096, 100): [BASE, (4, 201, 5000), (4, 201, 10_000)],
    (512, 200): [BASE, (4, 201, 5000)],
    (2048, 50): [BASE, (4, 201, 5000)],
}


def grid_folder(place: a9_runs.Place, grid: tuple[int, int]) -> pathlib.Path:
    cells, cell_mm = grid
    return place.images if grid == (1024, 100) else place.work / f"grid_{cells}_{cell_mm}/lab/target"


def runs(place: a9_runs.Place) -> list:
    return [lambda g=grid, p=point: scaling(place, grid_folder(place, g) / "scaling", *p)
            for grid, points in GRIDS.items() for point in points]
