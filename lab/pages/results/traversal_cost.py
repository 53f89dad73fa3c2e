"""Thesis, table 4.2: what a visited cell costs the Cortex-A9. Part of the section on traversal."""

import types

from claims import Claim, Verdict
from cortex_a9 import CortexA9, Modelled
from markdown import fixed, grouped

PAPER_SPEED_UP = 2.8  # 20 ms against 7 ms

# Walks on the Cortex-A9: the name on the page and the time by table 4.2.
COSTS = {"discrete r=20": ("discrete, r = 20", "7 ms"),
         "discrete r=100": ("discrete, r = 100", "7 ms"),
         "discrete r=200": ("discrete, r = 200", "7 ms"),
         "discrete r=1024": ("discrete, r = 1024", ""),
         "continuous_float": ("continuous, float", "20 ms"),
         "continuous_double": ("continuous, double", ""),
         "float_error": ("discrete, but the error term a float", ""),
         "bresenham": ("Bresenham", "")}
DISCRETE = [walk for walk in COSTS if walk.startswith("discrete")]


class Cost:
    """What a walk costs on the Cortex-A9."""

    def __init__(self, a9, walk):
        run = f"traversal_cost walk={walk}"
        self.name, self.paper = COSTS[walk]
        self.cells = a9.value(run, "cells")
        self.instructions = a9.value(run, "instructions")
        self.modelled = a9.cost(run)

    @property
    def per_cell(self):
        return self.instructions / self.cells

    @property
    def cycles_per_cell(self):
        return self.modelled.cycles * (1 / self.cells)


def _speed_up(costs):
    """Each variant against itself."""
    slow, quick = (costs[walk].modelled.cycles for walk in ("continuous_float", "discrete r=1024"))
    return Modelled(slow.nominal / quick.nominal, slow.optimistic / quick.optimistic,
                    slow.pessimistic / quick.pessimistic)


def _instruction_ratio(costs, walk="continuous_float"):
    return costs[walk].per_cell / costs["discrete r=1024"].per_cell


def costs(data):
    a9 = CortexA9(data)
    return {walk: Cost(a9, walk) for walk in COSTS}


def _range(low, high, written):
    low, high = written(low), written(high)
    return high if low == high else f"{low} to {high}"


def claims(costs):
    ours = _speed_up(costs)
    per_cell = [costs[walk].per_cell for walk in DISCRETE]
    is_equal = _r_does_not_show(costs)
    return [
        Claim("table 4.2", "continuous against discrete traversal",
              f"{PAPER_SPEED_UP} times the time",
              f"{ours.banded(2)} times the cycles, modelled",
              ours.verdict(PAPER_SPEED_UP),
              ("not by the pessimistic variant of the model; " if ours.has_in_band(PAPER_SPEED_UP) else "") +
              f"{fixed(_instruction_ratio(costs), 2)} times the instructions, measured; what code "
              "the thesis compared is not known"),
        Claim("table 4.2", "what r does to the execution time", "7 ms at r = 20, 100 and 200",
              _range(min(per_cell), max(per_cell), lambda value: fixed(value, 2)) +
              " instructions a cell at 20, 100, 200 and 1024",
              *((Verdict.EQUALS,) if is_equal else (Verdict.FALLS_SHORT, "see the section")))]


def _r_does_not_show(costs):
    per_cell = [costs[walk].per_cell for walk in DISCRETE]
    return max(per_cell) - min(per_cell) < 0.005 * min(per_cell)


def _cost_table(costs):
    product = costs["discrete r=1024"]
    rows = []
    for cost in costs.values():
        cycles = cost.cycles_per_cell
        rows.append([cost.name, cost.paper, grouped(cost.cells), grouped(cost.instructions),
                     fixed(cost.per_cell, 2), fixed(cost.per_cell / product.per_cell, 2),
                     cycles.banded(1), fixed(cycles.nominal / product.cycles_per_cell.nominal, 2),
                     grouped(cost.modelled.l1d_refills), grouped(cost.modelled.l2_misses)])
    return rows


def found(costs):
    """What the template says of the table."""
    ratio = _speed_up(costs)
    float_cycles = (costs["float_error"].modelled.cycles.nominal /
                    costs["discrete r=1024"].modelled.cycles.nominal)
    dearest, *others = sorted((costs[walk] for walk in DISCRETE), reverse=True,
                              key=lambda cost: cost.modelled.mispredicts)
    other_mispredicts = [cost.modelled.mispredicts for cost in others]
    return types.SimpleNamespace(
        table=_cost_table(costs), r_does_not_show=_r_does_not_show(costs), paper=PAPER_SPEED_UP,
        speed_up=ratio.banded(2), holds_paper=ratio.has_in_band(PAPER_SPEED_UP),
        instruction_ratio=_instruction_ratio(costs),
        float_error_ratio=_instruction_ratio(costs, "float_error"), float_error_cycles=float_cycles,
        is_mostly_the_location=float_cycles - 1 < (ratio.nominal - 1) / 2,
        dearest=dearest.name.removeprefix("discrete, "),
        dearest_is_mispredicted=(dearest.modelled.cycles.nominal ==
                                 max(costs[walk].modelled.cycles.nominal for walk in DISCRETE)),
        dearest_mispredicts=dearest.modelled.mispredicts,
        other_mispredicts=_range(min(other_mispredicts), max(other_mispredicts), grouped))
