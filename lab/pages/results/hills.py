"""What the classes say where the world is not flat: each unit through simulated hills, with and without the keys
`ground` and `moved`."""

from types import SimpleNamespace

from claims import Goal
from markdown import fixed, grouped
from section import Section, select

SAID = ["moving", "open", "standing", "free", "unknown"]
COLUMNS = [f"{said}_returns" for said in SAID]
BAND, BOTH = "height band", "both keys"
SETTINGS = [BAND, BOTH]
CARS = {"roof_vlp16": "VLP-16", "roof_vlp32c": "VLP-32C", "roof_hdl32e": "HDL-32E", "roof_xt32": "PandarXT-32",
        "roof_os1_64": "OS1-64", "roof_hdl64e": "HDL-64E S3", "roof_pandar64": "Pandar64", "roof_ld_mrs": "LD-MRS",
        "reference_car": "four LUX"}
RANGES = {0: "0 to 15 m", 15: "15 to 25 m", 25: "25 to 50 m", 50: "from 50 m on"}
MATERIALS = {"wall": "walls and houses", "car": "parked cars", "pole": "trees, gates, poles", "foliage": "bushes",
             "person": "people", "bank": "the bridge's abutments", "rail": "the bridge", "kerb": "kerbs"}
MOST_MOVING, MOST_FREE = 0.5, 0.05


def of(rows, **where):
    """How many returns, and per cent of each word."""
    sums = select(rows, **where)[COLUMNS].sum()
    count = sums.sum()
    return SimpleNamespace(count=count, **{said: 100 * sums[f"{said}_returns"] / count if count else float("nan")
                                           for said in SAID})


def marked(rows, **where):
    """Per cent of the returns that the target takes for obstacles."""
    return 100 * of(rows, **where, is_marked=1).count / of(rows, **where).count


def shown(value, decimals=2):
    return "–" if value != value else fixed(value, decimals)


def _verdict(its):
    missed = [word for word, most in (("moving", MOST_MOVING), ("free", MOST_FREE)) if getattr(its, word) > most]
    return f"**missed: {', '.join(missed)}**" if missed else "met"


def _car_rows(rows):
    table = []
    for car, name in CARS.items():
        for setting in SETTINGS:
            its = of(rows, car=car, setting=setting, on="standing", is_marked=1)
            table.append([name, setting, grouped(its.count), *(shown(getattr(its, said), 3) for said in SAID),
                          shown(of(rows, car=car, setting=setting, on="standing").free),
                          _verdict(its) if setting == BOTH else ""])
    return table


def _marked_rows(rows):
    return [[name, setting, *(shown(marked(rows, car=car, setting=setting, on=on), 1)
                              for on in ("road", "beside the road", "standing", "moving"))]
            for car, name in CARS.items() for setting in SETTINGS]


def _moving_rows(rows):
    table = []
    for material, name in (("car", "cars"), ("person", "walkers")):
        for begin, words in RANGES.items():
            its = [of(rows, setting=setting, on="moving", material=material, range_from_m=begin, is_marked=1)
                   for setting in SETTINGS]
            if all(each.count for each in its):
                table.append([name, words, *(value for each in its for value in (grouped(each.count),
                                                                                 shown(each.moving, 1)))])
    return table


def _where_rows(rows):
    """Of the hits on what stands, with both keys."""
    hits = select(rows, setting=BOTH, on="standing", is_marked=1)
    whole = hits[COLUMNS].sum()
    table = []
    for material, name in MATERIALS.items():
        for begin, words in RANGES.items():
            its = of(hits, material=material, range_from_m=begin)
            if not its.count:
                continue
            share = {said: 100 * its.count * getattr(its, said) / 100 / whole[f"{said}_returns"]
                     for said in ("moving", "free")}
            table.append([name, words, grouped(its.count), shown(its.moving), shown(its.free, 3),
                          shown(share["moving"], 1), shown(share["free"], 1)])
    return table


def _worst(rows, word):
    """The unit with most of it, with both keys."""
    found = {name: getattr(of(rows, car=car, setting=BOTH, on="standing", is_marked=1), word)
             for car, name in CARS.items()}
    name = max(found, key=found.get)
    return found[name], name


def section(data):
    rows = data["hills_returns"]
    drives = data["hills_drives"]
    whole = {setting: of(rows, setting=setting, on="standing", is_marked=1) for setting in SETTINGS}
    goals = []
    for words, word, most in (("called moving", "moving", MOST_MOVING), ("called free", "free", MOST_FREE)):
        value, name = _worst(rows, word)
        goals.append(Goal(f"simulated hills, each unit: hits on what stands {words}", f"≤ {most} %",
                          f"{shown(value)} % ({name})", value <= most))
    return Section(found={
        "seeds": sorted(int(seed) for seed in drives["seed"].unique()), "seconds": int(drives["seconds"].iloc[0]),
        "units": len(CARS), "moving": {setting: shown(whole[setting].moving) for setting in SETTINGS},
        "free": {setting: shown(whole[setting].free, 3) for setting in SETTINGS},
        "all_free": {setting: shown(of(rows, setting=setting, on="standing").free) for setting in SETTINGS},
        "met": [name for car, name in CARS.items()
                if of(rows, car=car, setting=BOTH, on="standing", is_marked=1).moving <= MOST_MOVING],
        "cars": _car_rows(rows), "marked": _marked_rows(rows), "moving_things": _moving_rows(rows),
        "where": _where_rows(rows), "lost": int(drives["packets_not_placed"].sum())}, goals=goals)
