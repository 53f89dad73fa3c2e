"""The runs of lab/data/cortex_a9.csv that are of frames with classes; a9_runs.py says what a run is."""

import re

import a9_runs

# A frame is taken apart as in a9_runs.py. What a stage calls that is no stage is its own.
STAGES = {
    "receive": a9_runs.STAGES["receive"],
    "decode": ["app/perception_engine:receive", "app/perception_engine:keep"],
    "slices": ["app/perception_engine:open_slices"],
    "beams": a9_runs.STAGES["beams"],
    "carve": a9_runs.STAGES["carve"],
    "mark": a9_runs.STAGES["mark"],
    "join": ["app/perception_engine:join_group"],
    "pull": ["placing/frame_evidence:pull"],
    "push": ["placing/frame_evidence:push"],
    "clear": ["placing/slice_cells:clear", "placing/frame_evidence:clear"],
    "arrivals": ["perception/arrivals:find_new", "perception/arrivals:count_new"],
    "list": [f"perception/window_fusion:{name}"
             for name in ("decide", "decide_frame", "find_arrivals", "update_tiles", "end_frame")] +
            ["perception/ground:end_frame"],
    "update": ["perception/tile_fusion:fuse_groups"],
    "refresh": ["perception/window_fusion:update_tile"],
    "remember": ["perception/ground:remember"],
    "objects": [*(f"app/perception_engine:{name}" for name in ("begin_following", "look_at_hits", "follow_objects")),
                *(f"app/object_follower:{name}" for name in ("begin", "look_at_hits", "follow")), "placing/hit_list:add",
                "perception/moving_names:note_tile",
                "perception/moving_names:take_back"],
    "encode": ["target/perception_pass:take", "target/perception_pass:tick"],
    "encode_classes": ["app/perception_sink:take_classes"],
    "send": a9_runs.STAGES["send"],
}
OUTSIDE = {"benchmark": ["target/perception_pass:take_classes"],
           "stopwatch": a9_runs.OUTSIDE["stopwatch"]}
# What is likely, and what is safe; each takes minutes.
VARIANTS = ("nominal", "pessimistic")
# Frames that are forged so that following things in them is dear.
FOLLOWING = {"objects": ["objects/tracker:add"]}
FORGED = ("anywhere", "things", "walls", "crowd")
FORGED_FRAMES = 6
# Frames whose points are as dear as points can be, with poses, beside those of drives.
MOVING = "moving_"
FRAMES_OF_WORST = 12
# The window has to fill, too.
WARM_UP = 12
FRAMES = 4


def modelled(place: a9_runs.Place, drive: str, variant: str, capture: str) -> list[a9_runs.Row]:
    """A mean frame with classes, stage by stage, and the cycles of the dearest."""
    functions = STAGES | OUTSIDE
    printed = a9_runs.printed_by_model(place, variant, functions, place.images / "perception_cost",
                                       capture, FRAMES, WARM_UP)
    head, own = a9_runs.own_of(printed, functions)
    rounds = [0] * FRAMES
    for pairs in map(a9_runs.pairs_of, printed):
        if pairs.get("of") in STAGES:
            rounds[int(pairs["round"])] += int(pairs["cycles"])
    run = f"perception_cost drive={drive}"
    rows = a9_runs.modelled_rows(run, variant, {"frames": FRAMES, "before": WARM_UP,
                                                "groups_fused": head["groups_fused_after"]},
                                 a9_runs.with_whole({stage: own[stage] for stage in STAGES}, "frame"))
    return [*rows, a9_runs.Row(run, "frame", variant, "cycles_max", str(max(rounds)))]


def make_worst(place: a9_runs.Place) -> dict[str, str]:
    """Their captures by the names of their runs."""
    names = a9_runs.make_worst(place, "--poses", "--frames", str(FRAMES_OF_WORST), prefix=MOVING)
    return {f"worst_{name}": MOVING + a9_runs.worst_capture(name) for name in names}


def counted(place: a9_runs.Place, drive: str, capture: str) -> list[a9_runs.Row]:
    """Fails if the classes are not those of `iog fuse`."""
    line, = a9_runs.counted(place, "perception_cost", capture)
    report = a9_runs.output_of(place.iog, "fuse", "--pcap", place.work / capture)
    expected = re.search(r"^class run hash +(\w+)$", report, re.M).group(1)
    if a9_runs.pairs_of(line)["class_run_hash"] != expected:
        raise SystemExit(f"perception_cost {drive}: its classes are not those of iog fuse")
    return a9_runs.counted_rows(line, f"perception_cost drive={drive}")


def objects_run(kind: str) -> str:
    return f"object_cost kind={kind}"


def objects_counted(place: a9_runs.Place, kind: str) -> list[a9_runs.Row]:
    line, = a9_runs.counted(place, "object_cost", kind, FORGED_FRAMES)
    return a9_runs.counted_rows(line, objects_run(kind))


def objects_modelled(place: a9_runs.Place, kind: str, variant: str) -> list[a9_runs.Row]:
    """All frames' cycles, and the cycles of the dearest."""
    printed = a9_runs.printed_by_model(place, variant, FOLLOWING, place.images / "object_cost", kind, FORGED_FRAMES)
    _, own = a9_runs.own_of(printed, FOLLOWING)
    rounds = [int(pairs["cycles"]) for pairs in map(a9_runs.pairs_of, printed) if pairs.get("of") == "objects"]
    return [*a9_runs.modelled_rows(objects_run(kind), variant, {"frames": FORGED_FRAMES}, own),
            a9_runs.Row(objects_run(kind), "objects", variant, "cycles_max", str(max(rounds)))]


def runs(place: a9_runs.Place, drives: dict[str, str], variants=VARIANTS, worst: dict[str, str] | None = None) -> list:
    """What is counted, and what is modelled, but of the worst frames."""
    worst = worst or {}
    forged = [lambda k=kind: objects_counted(place, k) for kind in FORGED]
    forged += [lambda k=kind, v=variant: objects_modelled(place, k, v) for variant in variants for kind in FORGED]
    of_drives = [lambda d=drive, c=capture: counted(place, d, c)
                 for drive, capture in (drives | worst).items()]
    return forged + of_drives + [lambda d=drive, c=capture, v=variant: modelled(place, d, v, c)
                        for variant in variants for drive, capture in drives.items()]
