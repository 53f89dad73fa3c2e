"""What the firmware needs: memory by its images, and instructions as counted in QEMU."""

from cortex_a9 import CortexA9, frame_run
from markdown import fixed, grouped, percent
from section import Section, one, select

RUN = frame_run("city", coding="shortest")
RAW_RUN = frame_run("city")
SECTIONS = {"text": "code", "rodata": "constants", "data": "data", "bss": "zeroed data",
            "page_tables": "page tables", "stacks": "stacks and guards", "dma": "DMA"}
# Of the operations that a second pass calls one by one: what they are counted on.
OPERATIONS = (
    ("fuse: decode and check a packet, find its frame", "inspect", "packets", "packet"),
    ("fuse: what a point is good for", "judge", "points", "scan point"),
    ("fuse: where it carves, carving, remembering the mark (the rest)", "rest_of_fuse", "points",
     "scan point"),
    ("publish: find the known tiles", "find", "all_tiles", "tile"),
    ("publish: copy and hash", "hash", "tiles", "known tile"),
    ("publish: clear", "clear", "tiles", "known tile"),
    ("publish: encode and wrap (the rest)", "rest_of_publish", "tiles", "known tile"),
)


def _images(images):
    sections = select(images, what="section")
    return [[image, *(grouped(one(of_image, "bytes", name=name)) for name in SECTIONS)]
            for image, of_image in sections.groupby("image", sort=False)]


def _rows(images, what):
    return [[f"`{row.name}`", grouped(row.bytes)]
            for row in select(images, what=what).itertuples(index=False)]


def _stacks(images):
    return [[row.name, grouped(row.bytes), grouped(one(images, "bytes", what="guard", name=row.name))]
            for row in select(images, what="stack").itertuples(index=False)]


def _parts(a9):
    """The pipeline's and the Ethernet driver's, by sizeof."""
    of = {name: a9.value(RUN, f"{name}_bytes")
          for name in ("pipeline", "grid", "marks", "receive_descriptor", "receive_buffer",
                       "transmit_descriptor", "transmit_buffer")}
    return [[words, grouped(size)] for words, size in (
        ("pipeline: grid, one byte a cell", of["grid"]),
        ("pipeline: marks that wait for the frame's end", of["marks"]),
        ("pipeline: everything else", of["pipeline"] - of["grid"] - of["marks"]),
        ("Ethernet: receive descriptors", of["receive_descriptor"]),
        ("Ethernet: receive buffers", of["receive_buffer"]),
        ("Ethernet: transmit descriptors", of["transmit_descriptor"]),
        ("Ethernet: transmit buffers, a whole grid", of["transmit_buffer"]))]


def _stages(a9):
    whole = a9.value(RUN, "instructions", "frame")
    rows = []
    for stage in ("receive", "fuse", "mark", "publish", "frame"):
        total = a9.value(RUN, "instructions", stage)
        extremes = [grouped(a9.value(RUN, f"instructions_{end}", stage)) for end in ("min", "max")]
        rows.append(["**whole frame**" if stage == "frame" else stage,
                     grouped(a9.mean(RUN, "instructions", stage)), *extremes,
                     percent(total / whole, 1)])
    return rows


def _operations(a9):
    spent = {stage: a9.value(RUN, "instructions", stage)
             for stage in ("inspect", "judge", "points", "find", "hash", "clear", "publish")}
    spent["rest_of_fuse"] = spent["points"] - spent["judge"]
    spent["rest_of_publish"] = (spent["publish"] - spent["find"] - spent["hash"] - spent["clear"])
    frames = a9.value(RUN, "frames")
    counts = {name: a9.value(RUN, name) for name in ("packets", "points", "tiles")}
    counts["all_tiles"] = frames * a9.value(RUN, "tiles_per_grid")
    return [[words, grouped(spent[what] / frames), grouped(spent[what] / counts[each]), of]
            for words, what, each, of in OPERATIONS]


def _serial_line(a9):
    rows = []
    for scene in ("city", "ring_road"):
        run = f"serial_cost scene={scene}"
        rows.append([scene.replace("_", " "), *(
            grouped(a9.value(run, counter, stage)) for stage, counter in (
                ("frame", "instructions_mean"), ("pass", "instructions_mean"),
                ("pass", "instructions_max")))])
    return rows


def _things(a9):
    """Following things with a speed: instructions and modelled milliseconds of a mean frame."""
    runs = {drive.replace("_", " "): f"perception_cost drive={drive}" for drive in ("city", "ring_road")}
    return [[words, grouped(a9.mean(run, "instructions", "objects", "nominal")),
             fixed(a9.mean(run, "cycles", "objects", "nominal") / 1e6, 2)] for words, run in runs.items()]


def _per_point(a9):
    return {stage: grouped(a9.value(RUN, "instructions", stage) / a9.value(RUN, "points"))
            for stage in ("frame", "fuse", "aim")}


def _made_with(table):
    """Words of command lines as code."""
    return [[key, f"`{value}`" if key in ("flags of the core", "counting") else value]
            for key, value in table.itertuples(index=False) if not key.startswith("capture")]


def section(data) -> Section:
    a9, images = CortexA9(data), data["images"]
    mean = {name: grouped(a9.mean(RUN, name))
            for name in ("packets", "points", "points_used", "messages", "sent_bytes", "cells", "tiles")}
    raw = {name: grouped(a9.mean(RAW_RUN, name)) for name in ("messages", "sent_bytes")}
    raw["publish"] = grouped(a9.mean(RAW_RUN, "instructions", "publish"))
    return Section(found={
        "images": _images(images), "section_names": list(SECTIONS.values()),
        "objects": _rows(images, "object"), "parts": _parts(a9), "stacks": _stacks(images),
        "vehicle": a9.word(RUN, "vehicle"), "stack_bytes": grouped(a9.value(RUN, "stack_bytes")),
        "firmware_stack_bytes": grouped(one(images, "bytes", what="stack_used")),
        "frames": grouped(a9.value(RUN, "frames")), "mean": mean, "raw": raw,
        "drive": one(data["made_with"], "value", key="capture scene=city"),
        "stages": _stages(a9), "per_point": _per_point(a9), "run_hash": a9.word(RUN, "run_hash"),
        "counter": grouped(a9.value(RUN, "instructions", "counter")),
        "cells_a_point": grouped(a9.value(RUN, "cells") / a9.value(RUN, "points")),
        "tiles_per_grid": grouped(a9.value(RUN, "tiles_per_grid")),
        "operations": _operations(a9), "serial_line": _serial_line(a9), "things": _things(a9),
        "things_bytes": grouped(a9.value("object_cost kind=anywhere", "bytes")),
        "made_with": _made_with(data["made_with"])})
