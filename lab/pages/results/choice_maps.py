"""One frame's grid under several choices, side by side, from the maps of letters in
lab/data/choice_map_*.csv (lab/experiments/detection_quality/choice_maps.hpp says what the letters mean)."""

import math

import matplotlib.colors
import matplotlib.patches
import matplotlib.pyplot as plt
import numpy

import plots  # noqa: F401 ; the look of every plot

CELL_M = 0.1       # src/vehicle/grid_geometry.hpp
ORIGIN_CELL = 512
COLUMNS = 3
LOST = "x"  # a cell in which a beam ended, and which is free

KEY = {  # letter: colour, words
    "O": ("#D55E00", "occupied: more than one hit"),
    "o": ("#F0B040", "occupied: one hit at most"),
    ".": ("#FFFFFF", "unknown"),
    "f": ("#C2E2F5", "free: one beam at most"),
    "F": ("#6BB4DD", "free: more than one beam"),
    LOST: ("#000000", "free, yet a beam ended here"),
}
LETTERS = list(KEY)


class Map:
    """The letters of a square of the grid: letters[y, x]."""

    def __init__(self, rows):
        rows = rows.sort_values("y_cell")
        self.letters = numpy.array([list(cells) for cells in rows["cells"]])
        self.first_x = rows["first_x_cell"].iloc[0]
        self.first_y = rows["y_cell"].iloc[0]

    def with_lost(self, hits) -> "Map":
        """The same, with a letter of their own for the hits that came out free."""
        self.letters[numpy.isin(self.letters, ["f", "F"]) & (hits.letters == "O")] = LOST
        return self

    def count(self, letters) -> int:
        return int(numpy.isin(self.letters, list(letters)).sum())

    @property
    def lost(self) -> int:
        return self.count(LOST)

    def draw(self, axes):
        """Forward is up, left is left."""
        numbers = numpy.vectorize(LETTERS.index)(self.letters)
        left, up = self.letters.shape
        x = (self.first_x - ORIGIN_CELL) * CELL_M
        y = (self.first_y - ORIGIN_CELL) * CELL_M
        axes.imshow(numbers.T[:, ::-1], origin="lower", interpolation="nearest",
                    cmap=matplotlib.colors.ListedColormap([colour for colour, _ in KEY.values()]),
                    vmin=0, vmax=len(KEY) - 1,
                    extent=(y + left * CELL_M, y, x, x + up * CELL_M))


def maps(table, hits=None) -> dict[str, Map]:
    """By their names, in the order of the table."""
    read = {name: Map(rows) for name, rows in table.groupby("map", sort=False)}
    return {name: each.with_lost(hits) if hits else each for name, each in read.items()}


def figure(title: str, shown: dict[str, Map]):
    """Panels in rows of three, then the key."""
    rows = math.ceil((len(shown) + 1) / COLUMNS)
    drawing, panels = plt.subplots(rows, COLUMNS, figsize=(9, 3.1 * rows + 0.6), dpi=150)
    drawing.suptitle(title, fontsize=16, fontweight="bold", x=0.01, ha="left")
    places = list(panels.flat)
    for axes, (name, each) in zip(places, shown.items()):
        each.draw(axes)
        axes.grid(False)
        axes.set_title(f"{name}: {each.lost} lost" if each.lost else name, fontsize=12,
                       fontweight="normal")
        axes.tick_params(labelsize=10)
    for axes in panels[:, 0]:
        axes.set_ylabel("m ahead", fontsize=11)
    for axes in panels[-1, :]:
        axes.set_xlabel("m to the left", fontsize=11)
    _draw_key(places[len(shown)])
    for axes in places[len(shown) + 1:]:
        axes.set_axis_off()
    return drawing


def _draw_key(axes):
    axes.set_axis_off()
    patches = [matplotlib.patches.Patch(facecolor=colour, edgecolor="#777777", label=words)
               for colour, words in KEY.values()]
    axes.legend(handles=patches, loc="center", fontsize=12, borderaxespad=0, handlelength=1.2)
