"""The runs of lab/data/cortex_a9.csv that are of the map's layer; a9_runs.py says what a run is.

Of two maps: that of the simulated city, and a town denser than any, with 20 corners a house.
"""

import json
import math
import typing

import a9_runs

FRAMES = 100
VARIANTS = ("nominal", "pessimistic")
FUNCTIONS = {"layer": ["map/layer:work"]}
CITY_ORIGIN = (-48.876667, -123.393333)  # where iog simulate has its cities
TOWN_ORIGIN = (48.0, 2.0)


class Town(typing.NamedTuple):
    """Houses, and every third a piece of road, on a lattice around the origin."""

    reach_m: int = 250
    step_m: int = 4
    corners: int = 20
    radius_m: float = 1.7


class Begin(typing.NamedTuple):
    """Where the car begins in the map's plane, in metres."""

    east: int
    north: int


BEGINS = {"city": Begin(480, -40), "dense_town": Begin(0, 0)}
METRES_PER_DEGREE = 40_000_000 / 360  # near enough: nothing is measured on this map


def corners_of(town: Town, east: float, north: float) -> list[list[float]]:
    """A star, closed, as GeoJSON has it: longitude first."""
    latitude, longitude = TOWN_ORIGIN
    ring = []
    for corner in range(town.corners + 1):
        angle = 2 * math.pi * (corner % town.corners) / town.corners
        radius = town.radius_m * (1 if corner % 2 else 0.7)
        x, y = east + radius * math.cos(angle), north + radius * math.sin(angle)
        ring.append([
            round(longitude + x / METRES_PER_DEGREE / math.cos(math.radians(latitude)), 8),
            round(latitude + y / METRES_PER_DEGREE, 8)])
    return ring


def geojson_of(town: Town) -> dict:
    places = range(-town.reach_m, town.reach_m, town.step_m)
    return {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"kind": "building" if (i + j) % 3 else "road"},
         "geometry": {"type": "Polygon", "coordinates": [corners_of(town, east, north)]}}
        for j, north in enumerate(places) for i, east in enumerate(places)]}


def block_of(name: str) -> str:
    return f"{name}.iogmap"


def make_maps(place: a9_runs.Place) -> None:
    """The city's as qemu/run makes it."""
    city, town = place.work / "city.osm", place.work / "dense_town.geojson"
    a9_runs.output_of(place.iog, "simulate", "--vehicle", "reference_car", "--seed", 1, "--seconds",
                      1, "--moving", "--out", place.work / "map_drive.pcap", "--osm", city)
    town.write_text(json.dumps(geojson_of(Town())))
    for path, origin, options in ((city, CITY_ORIGIN, ()),
                                  (town, TOWN_ORIGIN, ("--accuracy", 500, "--attribution", "none"))):
        a9_runs.output_of(place.iog, "map", path, f"--origin={origin[0]},{origin[1]}", *options,
                          "--out", place.work / block_of(path.stem))


def arguments_of(name: str) -> list:
    """Of the image, which counts metres from 100 km west and south."""
    return [block_of(name), FRAMES, *(100_000 + metres for metres in BEGINS[name])]


def run_of(name: str) -> str:
    return f"map_cost map={name}"


def counted(place: a9_runs.Place, name: str) -> list[a9_runs.Row]:
    line, = a9_runs.counted(place, "map_cost", *arguments_of(name))
    return a9_runs.counted_rows(line, run_of(name))


def modelled(place: a9_runs.Place, name: str, variant: str) -> list[a9_runs.Row]:
    """All frames' cycles, and the cycles of the dearest."""
    printed = a9_runs.printed_by_model(place, variant, FUNCTIONS, place.images / "map_cost",
                                       *arguments_of(name))
    head, own = a9_runs.own_of(printed, FUNCTIONS)
    rounds = [int(pairs["cycles"]) for pairs in map(a9_runs.pairs_of, printed)
              if pairs.get("of") == "layer"]
    return [*a9_runs.modelled_rows(run_of(name), variant,
                                   {"frames": FRAMES, "tiles": head["tiles"]}, own),
            a9_runs.Row(run_of(name), "layer", variant, "cycles_max", str(max(rounds)))]


def runs(place: a9_runs.Place, variants=VARIANTS) -> list:
    """What is counted, and what is modelled; of make_maps()."""
    return ([lambda n=name: counted(place, n) for name in BEGINS] +
            [lambda n=name, v=variant: modelled(place, n, v)
             for variant in variants for name in BEGINS])
