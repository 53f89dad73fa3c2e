"""What was counted on the emulated Cortex-A9, and what its cost model says that takes
(lab/data/cortex_a9.csv, written by lab/target/measure_a9; docs/a9_model.md).

A run is named by its program and what it was given, e.g. "frame_cost scene=city sensors=4",
"frame_cost worst=flood sensors=4 paths=forgotten", "traversal_cost walk=discrete r=100". Its values
are those of a stage, or of the whole run (stage ""). Variant "counted" is what QEMU counted, the
same in every run; "nominal", "optimistic" and "pessimistic" are modelled. Both are sums over the
frames of a run; cost() and frame() are of a mean frame.
"""

import dataclasses
import functools

import pandas

from claims import Verdict

CLOCK_HZ = 1e9
VARIANTS = ("nominal", "optimistic", "pessimistic")

# A frame is taken apart so that these add up to it (lab/target/a9_runs.py), and so do groups.
STAGES = ("receive", "decode", "beams", "carve", "mark", "encode", "send", "clear")
FUSE = ("beams", "carve")
PUBLISH = ("encode", "send", "clear")
FUSED = ("decode", *FUSE, "mark", "clear")  # a grid, without sending it


@dataclasses.dataclass(frozen=True)
class Modelled:
    """The same quantity by the three variants."""

    nominal: float = 0
    optimistic: float = 0
    pessimistic: float = 0

    def map(self, function) -> "Modelled":
        return Modelled(*(function(getattr(self, variant)) for variant in VARIANTS))

    def __add__(self, other: "Modelled") -> "Modelled":
        return Modelled(*(getattr(self, variant) + getattr(other, variant)
                          for variant in VARIANTS))

    def __mul__(self, factor: float) -> "Modelled":
        return self.map(lambda value: value * factor)

    @property
    def low(self) -> float:
        return min(self.nominal, self.pessimistic)

    @property
    def high(self) -> float:
        return max(self.nominal, self.pessimistic)

    @property
    def hz(self) -> "Modelled":
        """Of cycles: how often a second a core at 1 GHz does what takes so many."""
        return self.map(lambda cycles: CLOCK_HZ / cycles)

    @property
    def ms(self) -> "Modelled":
        """Of cycles: milliseconds at 1 GHz."""
        return self.map(lambda cycles: cycles / CLOCK_HZ * 1e3)

    def banded(self, decimals: int) -> str:
        """12.4 (16.0): nominal, and pessimistic. What is faster than nominal is no bound (docs/a9_model.md)."""
        return f"{self.nominal:,.{decimals}f} ({self.pessimistic:,.{decimals}f})"

    def has_in_band(self, paper: float) -> bool:
        """Whether the pessimistic variant would have decided otherwise."""
        return self.low <= paper <= self.high

    def verdict(self, paper: float) -> Verdict:
        """Of a number of which more is better: decided by the nominal variant."""
        return Verdict.BEATS if self.nominal > paper else Verdict.FALLS_SHORT


@dataclasses.dataclass(frozen=True)
class Cost:
    """What a stage or some of them take; all but the cycles by the nominal variant."""

    cycles: Modelled = Modelled()
    instructions: float = 0
    l1d_refills: float = 0
    l2_misses: float = 0
    mispredicts: float = 0

    def __add__(self, other: "Cost") -> "Cost":
        return Cost(*(getattr(self, field.name) + getattr(other, field.name)
                      for field in dataclasses.fields(self)))

    def cycles_of(self, instructions: float) -> Modelled:
        """What so many instructions take at the rate of this stage."""
        return self.cycles * (instructions / self.instructions)


@dataclasses.dataclass(frozen=True)
class Frame:
    """A mean frame, as counted: what it has, and its instructions."""

    points: float
    points_used: float
    cells: float    # carved
    tiles: float    # in which something is known
    receive: float  # instructions, as all below
    fuse: float     # with decoding
    mark: float
    publish: float  # with clearing
    fused: float    # fuse, mark and clear
    whole: float    # receive, fuse, mark and publish
    largest: float  # the whole of the dearest frame


def frame_run(scene: str = "", sensors: int = 4, *, worst: str = "", paths: str = "kept",
              coding: str = "raw", program: str = "frame_cost") -> str:
    """The name of a run over frames: of a scene of `iog simulate`, or of a kind of worst_frames."""
    words = [program, f"worst={worst}" if worst else f"scene={scene}", f"sensors={sensors}"]
    words += [f"paths={paths}"] * (paths != "kept") + [f"coding={coding}"] * (coding != "raw")
    return " ".join(words)


@functools.cache
def _values_of(path) -> dict:
    # Words: a run hash of digits alone is no number.
    table = pandas.read_csv(path, dtype=str, keep_default_na=False)
    return {tuple(keys): value for *keys, value in table.itertuples(index=False)}


class CortexA9:
    """The table, by its keys."""

    def __init__(self, data):
        self._values = _values_of(data.path("cortex_a9.csv"))

    def has(self, run: str, variant: str = "counted") -> bool:
        return any(key[0] == run and key[2] == variant for key in self._values)

    def runs(self, program: str, variant: str = "counted") -> list[str]:
        """The names of its runs, in the order of the table."""
        return list(dict.fromkeys(run for run, _, its_variant, _ in self._values
                                  if its_variant == variant and run.split(" ")[0] == program))

    def word(self, run: str, counter: str, stage: str = "", variant: str = "counted") -> str:
        """What is not a number: a run hash, a vehicle's name."""
        key = (run, stage, variant, counter)
        assert key in self._values, f"lab/data/cortex_a9.csv: no {key}"
        return self._values[key]

    def value(self, run: str, counter: str, stage: str = "", variant: str = "counted") -> float:
        return float(self.word(run, counter, stage, variant))

    def mean(self, run: str, counter: str, stage: str = "", variant: str = "counted") -> float:
        """Of a frame."""
        return self.value(run, counter, stage, variant) / self._frames(run, variant)

    def modelled(self, run: str, counter: str, stage: str = "") -> Modelled:
        """A mean frame's. A run that has the nominal variant alone has it for all."""
        return Modelled(*(self.mean(run, counter, stage, variant if
                                    (run, stage, variant, counter) in self._values else "nominal")
                          for variant in VARIANTS))

    def cost(self, run: str, *stages: str) -> Cost:
        """A mean frame's, by the model: of these stages together, of the whole run without any."""
        total = Cost()
        for stage in stages or ("",):
            total += Cost(self.modelled(run, "cycles", stage),
                          *(self.mean(run, counter, stage, "nominal") for counter in
                            ("instructions", "l1d_refills", "l2_misses", "mispredicts")))
        return total

    def frame(self, run: str) -> Frame:
        """A mean frame's, as counted."""
        def instructions(stage):
            return self.mean(run, "instructions", stage)
        counts = (self.mean(run, counter) for counter in ("points", "points_used", "cells", "tiles"))
        return Frame(*counts, receive=instructions("receive"), fuse=instructions("fuse"),
                     mark=instructions("mark"), publish=instructions("publish"),
                     fused=instructions("fuse") + instructions("mark") + instructions("clear"),
                     whole=instructions("frame"),
                     largest=self.value(run, "instructions_max", "frame"))

    def _frames(self, run: str, variant: str) -> float:
        """What is not of frames is of one."""
        return float(self._values.get((run, "", variant, "frames"), 1))
