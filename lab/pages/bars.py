"""Plots of bars: few values side by side, each written at the end of its bar."""

import plots


def horizontal(title: str, x_label: str, names: list[str], series: dict[str, list[float]],
               form: str = "%.1f", colours: list[str] = plots.COLOURS):
    """A figure, and its axes: for each name a group of bars, one of each series. With one series
    the colours are those of its bars, and there is no legend."""
    drawing, axes = plots.figure("", x_label, "")
    # Over the names as well, which may be long.
    drawing.suptitle(title, x=0.01, horizontalalignment="left", fontweight="bold", fontsize=16)
    height = 0.8 / len(series)
    for number, (label, values) in enumerate(series.items()):
        shift = height * (number - (len(series) - 1) / 2)
        drawn = axes.barh([place + shift for place in range(len(names))], values, label=label,
                          height=0.94 * height,
                          color=colours[number] if len(series) > 1 else colours[:len(names)])
        axes.bar_label(drawn, fmt=form, padding=4)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.margins(x=0.1)  # room for the numbers
    if len(series) > 1:
        axes.legend(loc="lower right")
    return drawing, axes
