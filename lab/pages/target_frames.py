"""Mean frames of a run on the target, and the floor below them.

Counted are all frames of a drive, modelled the first of them: what all take is their instructions
at the instructions a cycle that the model finds for these.
"""

import dataclasses

from cortex_a9 import FUSED, CLOCK_HZ, CortexA9, Cost, Frame, Modelled

WHOLE = "frame"  # the stage that is all of them
SCENES = {"ring_road": "ring road", "city": "city"}  # the matched load first


@dataclasses.dataclass(frozen=True)
class TargetFrame:
    run: str
    counted: Frame
    fused: Cost  # modelled, as whole: decoded, fused, marked and cleared
    whole: Cost

    @property
    def fused_cycles(self) -> Modelled:
        return self.fused.cycles_of(self.counted.fused)

    @property
    def whole_cycles(self) -> Modelled:
        return self.whole.cycles_of(self.counted.whole)

    @property
    def largest_cycles(self) -> Modelled:
        """The largest frame's, at the rate of the mean one."""
        return self.whole.cycles_of(self.counted.largest)


def target_frame(a9: CortexA9, run: str) -> TargetFrame:
    return TargetFrame(run, a9.frame(run), a9.cost(run, *FUSED), a9.cost(run, WHOLE))


@dataclasses.dataclass(frozen=True)
class Floor:
    """Each line of the grid of which a frame leaves something known is read and written once, sent
    once and cleared once, and nothing else. Nominal cycles of a mean frame."""

    lines: float
    fuse: float
    clear: float
    send: float

    @property
    def fused(self) -> float:
        return self.fuse + self.clear

    @property
    def whole(self) -> float:
        return self.fused + self.send

    @property
    def fused_hz(self) -> float:
        return CLOCK_HZ / self.fused

    @property
    def whole_hz(self) -> float:
        return CLOCK_HZ / self.whole


def floor(a9: CortexA9, frames: str) -> Floor:
    """Of "scene=city" or "worst=flood"."""
    run = f"floor {frames}"
    return Floor(a9.mean(run, "lines", variant="nominal"),
                 *(a9.cost(run, stage).cycles.nominal for stage in ("fuse", "clear", "send")))
