"""The look of every plot: one title that says what is seen, readable at half its size, colours that
the colour-blind tell apart, and the same bytes for the same data."""

import pathlib

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402 ; after the choice of what draws

# Of M. Okabe and K. Ito, "Color Universal Design" (2008); without its yellow, too pale on white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#000000", "#56B4E9"]
MARKERS = ["o", "s", "^", "D", "v", "x", "P"]
DASHES = ["-", "--", ":", "-.", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1))]
PAPER = "#777777"  # what a paper printed, beside ours

plt.rcParams.update({
    "figure.figsize": (8, 4.5), "figure.constrained_layout.use": True,
    "font.family": ["DejaVu Sans", "sans-serif"], "font.size": 14,
    "axes.titlesize": 16, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.grid": True, "grid.color": "#DDDDDD", "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False,
    "lines.linewidth": 2, "lines.markersize": 6, "legend.frameon": False,
    "axes.prop_cycle": plt.cycler(color=COLOURS),
    # A page opens all of its figures before it writes them.
    "figure.max_open_warning": 0,
    # Text stays text, ids do not change from run to run.
    "svg.fonttype": "none", "svg.hashsalt": "iogrid",
})


def figure(title: str, x_label: str, y_label: str):
    """A figure and its one pair of axes."""
    drawing, axes = plt.subplots()
    axes.set_title(title)
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    return drawing, axes


def save(drawing, path: pathlib.Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    metadata = {"Date": None, "Creator": None} if path.suffix == ".svg" else {"Software": None}
    drawing.savefig(path, metadata=metadata)
    plt.close(drawing)
