"""Curves over all thresholds: what moves against what stands, drivable ground against all other, with
the map and without it."""

from types import SimpleNamespace

import numpy

import plots
from markdown import fixed, percent
from section import Section, select

SCENES = {"city": "city", "street": "street"}
GRIDS = ["map in every scan", "map at decision", "no map", "the firmware's", "the firmware's, no map"]
QUESTIONS = {"moving": "What moves, told from what stands",
             "drivable": "Drivable ground, told from all other"}
DECISION = 50  # per cent: the threshold of the decision for both classes


class Curve:
    """Shares of a class and of all others at or above each threshold."""

    def __init__(self, data, scene, grid, question):
        rows = select(data, scene=scene, grid=grid, **{"class": question}).sort_values("threshold_percent")
        self.of_class = rows["of_class"].to_numpy() / rows["of_class"].iloc[0]
        self.others = rows["others"].to_numpy() / rows["others"].iloc[0]

    @property
    def area(self):
        """Under the curve, between its points straight: a tie counts half."""
        return -numpy.trapz([*self.of_class, 0], [*self.others, 0])

    @property
    def decision(self):
        return SimpleNamespace(of_class=self.of_class[DECISION], others=self.others[DECISION])


def _figure(curves, question, scene):
    drawing, axes = plots.figure(f"{QUESTIONS[question]}: {SCENES[scene]}", "others, called so, %",
                                 "of the class, called so, %")
    for number, grid in enumerate(GRIDS):
        curve = curves[scene, grid, question]
        axes.plot(100 * curve.others, 100 * curve.of_class, color=plots.COLOURS[number],
                  linestyle=plots.DASHES[number], label=grid)
        axes.plot(100 * curve.decision.others, 100 * curve.decision.of_class, linestyle="none",
                  color=plots.COLOURS[number], marker=plots.MARKERS[number])
    axes.set_xlim(-1, 101)
    axes.set_ylim(-1, 101)
    axes.legend()
    return drawing


def _rows(curves, question):
    rows = []
    for grid in GRIDS:
        row = [grid]
        for scene in SCENES:
            curve = curves[scene, grid, question]
            row += [percent(curve.decision.of_class, 1), percent(curve.decision.others, 2),
                    fixed(curve.area, 3)]
        rows.append(row)
    return rows


def section(data) -> Section:
    table = data["evidential_roc"]
    curves = {(scene, grid, question): Curve(table, scene, grid, question)
              for scene in SCENES for grid in GRIDS for question in QUESTIONS}
    return Section(
        found={"questions": QUESTIONS, "rows": {question: _rows(curves, question) for question in QUESTIONS},
               "of": curves, "scenes": SCENES},
        figures={f"roc_{question}_{scene}.svg": _figure(curves, question, scene)
                 for question in QUESTIONS for scene in SCENES})
