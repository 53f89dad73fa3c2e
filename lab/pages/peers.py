"""Times of other grid libraries beside ours, on a PC."""

import claims as verdicts
from markdown import grouped
from peer_times import GOALS, NAMES, OURS, SCENES, WHAT, PeerTimes, ratio_text
from section import Section


def _scene(times, scene):
    rows = []
    for name, words in NAMES.items():
        row = [words]
        for what in ("fuse", "both"):
            row += [grouped(times.of(scene, name).median(what)),
                    ratio_text(times.ratio(scene, name, what))]
        rows.append([*row, f"± {100 * times.of(scene, name).spread:.1f} %"])
    counts = {key: grouped(times.a_frame(scene, key))
              for key in ("beams", "updates", "only_carving", "later_echoes")}
    return {"frames": times.frames(scene), "rows": rows, **counts}


def _goals(times):
    """The scene with the smaller ratio decides."""
    goals = []
    for goal in GOALS:
        found = [times.ratio(scene, goal.peer, goal.what) for scene in SCENES]
        goals.append(verdicts.Goal(f"on a PC, beside {NAMES[goal.peer]}, {WHAT[goal.what]}",
                                   f"≥ {grouped(goal.ratio)} × our time",
                                   " and ".join(f"{ratio_text(ratio)} ×" for ratio in found),
                                   min(found) >= goal.ratio))
    return goals


def _cells(times):
    return [[words, *(grouped(getattr(times.of(scene, name), f"{kind}_cells"))
                      for scene in SCENES for kind in ("free", "occupied", "stored"))]
            for name, words in NAMES.items()]


def section(data) -> Section:
    times = PeerTimes(data)
    context = times.context
    made_with = dict(data["peers_made_with"].itertuples(index=False))
    return Section(found={
        "city": _scene(times, "city"), "ring_road": _scene(times, "ring_road"),
        "cells": _cells(times),
        "mrpt": [ratio_text(times.ratio(scene, "mrpt", "fuse")) for scene in SCENES],
        "repetitions": len(times.of("city", OURS).both),
        "load": f"{context['load_avg'][0]:.1f}", "processors": context["num_cpus"],
        "date": context["date"][:10],
        "commit": made_with["commit"], "processor": made_with["processor"],
        "made_with": [list(row) for row in made_with.items()]}, goals=_goals(times))
