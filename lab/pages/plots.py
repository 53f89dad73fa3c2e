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


def curves(table, x: str, y: str, by: str | None = None, **style) -> list[dict]:
    """A series for lines(): of these columns, which may be expressions, one for each value of a third."""
    groups = table.groupby(by, sort=False) if by else [(None, table)]
    return [{"x": rows.eval(x), "y": rows.eval(y), **({"label": str(name)} if by else {}), **style}
            for name, rows in groups]


def lines(title: str, x_label: str, y_label: str, series: list[dict], legend: dict | None = None, level=None,
          ticks: dict | None = None, **settings):
    """A figure of series: x, y and what matplotlib's plot() takes. level: a line across. ticks: by axis, {value: words}.
    settings: of the axes, as xscale="log"."""
    drawing, axes = figure(title, x_label, y_label)
    for number, one in enumerate(series):
        style = {"linestyle": DASHES[number % len(DASHES)], **one}
        axes.plot(style.pop("x"), style.pop("y"), **style)
    if level is not None:
        axes.axhline(level, color="black", linestyle=":")
    axes.set(**settings)
    for axis, values in (ticks or {}).items():
        getattr(axes, f"set_{axis}ticks")(list(values), list(values.values()) if isinstance(values, dict) else None)
    if any("label" in one for one in series):
        axes.legend(**(legend or {}))
    return drawing


def bars(title: str, x_label: str, names: list[str], series: dict[str, list[float]], form: str = "%.1f",
         colours=COLOURS, level=None, size=None):
    """A figure: for each name a group of horizontal bars, one of each series, with its value at its end. With one
    series the colours are those of its bars, and there is no legend. level: a line across."""
    drawing, axes = figure("", x_label, "")
    # Over the names as well, which may be long.
    drawing.suptitle(title, x=0.01, horizontalalignment="left", fontweight="bold", fontsize=16)
    height = 0.8 / len(series)
    for number, (label, values) in enumerate(series.items()):
        shift = height * (number - (len(series) - 1) / 2)
        drawn = axes.barh([place + shift for place in range(len(names))], values, label=label, height=0.94 * height,
                          color=colours[number] if len(series) > 1 else colours[:len(names)])
        axes.bar_label(drawn, fmt=form, padding=4)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.margins(x=0.1)  # room for the numbers
    if level is not None:
        axes.axvline(level, color="black", linestyle="--")
    if len(series) > 1:
        axes.legend(loc="lower right")
    if size:
        drawing.set_size_inches(*size)
    return drawing


def save(drawing, path: pathlib.Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    metadata = {"Date": None, "Creator": None} if path.suffix == ".svg" else {"Software": None}
    drawing.savefig(path, metadata=metadata)
    plt.close(drawing)
