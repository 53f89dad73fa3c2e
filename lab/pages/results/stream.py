"""What it takes to send a grid: bytes, cycles, and what a bad link or a slow one leaves of it. The
papers send none; the thesis's conclusion asks for a smaller grid."""

import types

import bars
from cortex_a9 import PUBLISH, CortexA9, frame_run
from markdown import fixed, grouped, percent
from section import Section, one, select

SCENES = {"city": "city", "ring_road": "ring road"}
ENCODINGS = ("raw", "run_starts", "run_starts_since")
TILES, TILE_BYTES = 1024, 1024  # of the grid; of a raw tile (docs/spec.md 3.4)
FRAMES_A_SECOND = 25
PERIOD_MS = 40
LINK_MBIT = 100  # of the board's Ethernet


def _weighed(frames, sent, of):
    """Of each drive or recording: bytes of a mean frame, and the shares of the encodings."""
    weighed = {}
    for row in frames.itertuples():
        name = getattr(row, of)
        of_it = select(sent, **{of: name})
        weighed[name] = types.SimpleNamespace(
            frames=row.frames, tiles=row.known_tiles / row.frames,
            messages=row.messages / row.frames, message_bytes=row.message_bytes / row.frames,
            payloads={"raw": row.known_tiles * TILE_BYTES / row.frames,
                      "alone": row.alone_bytes / row.frames,
                      "as sent": of_it["payload_bytes"].sum() / row.frames},
            shares=[one(of_it, "tiles", encoding=encoding) / row.known_tiles
                    for encoding in ENCODINGS])
    return weighed


def _kilobytes(count):
    return fixed(count / 1000, 1)


def _times_below_raw(weighed):
    return weighed.payloads["raw"] / weighed.payloads["as sent"]


def _bytes_rows(weighed):
    return [[SCENES.get(name, name), grouped(each.frames), grouped(each.tiles),
             *map(_kilobytes, each.payloads.values()), fixed(_times_below_raw(each), 1),
             _kilobytes(each.message_bytes), grouped(each.messages)]
            for name, each in weighed.items()]


def _shares_rows(weighed):
    return [[SCENES.get(name, name), *(percent(share, 1) for share in each.shares)]
            for name, each in weighed.items()]


def _bytes_figure(weighed):
    least = min(map(_times_below_raw, weighed.values()))
    kilobytes = {SCENES[scene]: [count / 1000 for count in each.payloads.values()]
                 for scene, each in weighed.items()}
    drawing, _ = bars.horizontal(
        f"As sent, a frame is {fixed(least, 1)} times smaller than raw, or more",
        "payloads of a mean frame, KB", list(weighed["city"].payloads), kilobytes)
    return drawing


def _mbit(bytes_a_frame):
    return bytes_a_frame * 8 * FRAMES_A_SECOND / 1e6


def _bytes(data, a9):
    weighed = _weighed(data["stream_frames"], data["stream_sent"], "scene")
    raw_mbit = _mbit(a9.mean(frame_run("ring_road"), "sent_bytes"))
    found = {"bytes": _bytes_rows(weighed), "shares": _shares_rows(weighed),
             "raw_grid_kilobytes": TILES * TILE_BYTES / 1000,
             "ring_road_mbit": _mbit(weighed["ring_road"].message_bytes),
             "ring_road_raw_mbit": raw_mbit, "link_mbit": LINK_MBIT,
             "raw_does_not_fit": raw_mbit > LINK_MBIT}
    return found, weighed


def _recordings(data):
    if "stream_frames_recordings" not in data:
        return {"recordings": None}
    weighed = _weighed(data["stream_frames_recordings"], data["stream_sent_recordings"],
                       "recording")
    return {"recordings": types.SimpleNamespace(bytes=_bytes_rows(weighed),
                                                shares=_shares_rows(weighed))}


def _cycles(a9):
    rows = []
    for scene, words in SCENES.items():
        for coding in ("raw", "shortest"):
            run = frame_run(scene, coding=coding)
            publish, whole = a9.cost(run, *PUBLISH), a9.cost(run, "frame")
            rows.append([f"{words}, {coding}", grouped(publish.instructions),
                         f"{publish.cycles.ms.banded(2)} ms", f"{whole.cycles.hz.banded(0)} Hz",
                         percent(1 - whole.cycles.ms.nominal / PERIOD_MS, 0)])
    return rows


def _bad_link(data):
    trials = data["stream_bad_link"]
    rows = []
    for harm, of_harm in trials.groupby("harm", sort=False):
        sums = of_harm.sum(numeric_only=True)
        rows.append([harm, percent(sums["whole_frames"] / sums["frames"], 0),
                     percent(sums["fresh_tiles"] / sums["shown_tiles"], 1),
                     grouped(sums["damaged_messages_found"]), grouped(sums["wrong_tiles"]),
                     of_harm["incomplete_quiet_frames"].max() + 1])
    quiet_from, max_age = (set(trials[column]) for column in
                           ("quiet_from_frame", "max_reference_age_frames"))
    assert len(quiet_from) == len(max_age) == 1, "the trials are not of one drive and one stream"
    max_age = max_age.pop()
    return {"harms": rows, "quiet_from": quiet_from.pop(), "max_age": max_age,
            "seeds": trials["seed"].nunique(),
            "promise_is_kept": trials["incomplete_quiet_frames"].max() + 1 <= max_age + 1,
            "no_tile_is_wrong": not trials["wrong_tiles"].any()}


def _serial_line(data, weighed):
    rounds = data["stream_serial_line"]
    line_bytes = rounds["line_bytes_per_second"].unique()
    assert len(line_bytes) == 1, "several serial links"
    least = min(each.message_bytes * FRAMES_A_SECOND for each in weighed.values())
    return {"line_bytes": line_bytes[0], "frames_by_line": least / line_bytes[0],
            "rounds": [[f"{SCENES[row.scene]}, cells of {fixed(row.cell_mm / 1000, 1)} m",
                        grouped(row.bytes / row.rounds), fixed(row.time_us / row.rounds / 1e6, 2)]
                       for row in rounds.itertuples()]}


def section(data) -> Section:
    a9 = CortexA9(data)
    found, weighed = _bytes(data, a9)
    return Section(found={**found, **_recordings(data), "cycles": _cycles(a9), **_bad_link(data),
                          **_serial_line(data, weighed)},
                   figures={"stream_bytes.svg": _bytes_figure(weighed)})
