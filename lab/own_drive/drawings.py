"""The pictures of the page: cells as PNG in a data URI, curves as SVG that takes the colour of the page's text."""

import base64
import io
import math
import pathlib
import re
import tempfile

import numpy as np
import plots
from matplotlib import pyplot as plt
from matplotlib.patches import Polygon

from drive import Drive, Followed, World
from iogrid import Class, Frame, State

# Of `iog`: tools/formats/picture/class_picture.cpp and grid_picture.cpp; tests/e2e/own_drive compares them.
NOTHING = (30, 33, 38)
COLOURS = {Class.UNKNOWN: NOTHING, Class.DRIVABLE_FREE: (150, 214, 170), Class.NON_DRIVABLE_FREE: (120, 150, 130),
           Class.FREE: (172, 200, 222), Class.MOVING: (255, 40, 160), Class.STOPPED: (250, 190, 40),
           Class.STANDING: (214, 120, 40), Class.INFRASTRUCTURE: (140, 80, 40), Class.OCCUPIED: (240, 230, 120)}
PLAIN, WORDS = "#1E2126", "#EBEBE6"
PASSED, HIT = (206, 224, 236), (238, 120, 20)
OF_CLASSES = np.array([COLOURS[each] for each in sorted(Class)], np.uint8)
ORDER = np.array([0, 1, 1, 1, 5, 4, 3, 3, 2])  # of Class: what is drawn over what
REACH_M, MAP_PIXELS, MOST_BINS = 40, 1400, 240
# Readable on white and on black; dashes tell them apart, too.
LINES = {"free": "#2E86C1", "moving": "#E6007E", "stopped": "#B8860B", "standing": "#D0701A", "mapped": "#8C5028",
         "occupied": "#8A8A00", "unknown": "#808890", "hit": "#D0701A", "passed": "#2E86C1",
         "moving_objects": "#E6007E"}


def png(drawing) -> str:
    file = io.BytesIO()
    drawing.savefig(file, format="png", dpi=125, metadata={"Software": None}, facecolor=PLAIN)
    plt.close(drawing)
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


def svg(drawing, name: str) -> str:
    """The element, for a page in which black and white are those of its reader."""
    with tempfile.TemporaryDirectory() as folder:
        plots.save(drawing, path := pathlib.Path(folder) / "drawing.svg")
        text = path.read_text(encoding="utf-8")
    text = text[text.index("<svg "):]
    for plain, themed in (("#000000", "currentColor"), ("fill: #ffffff", "fill: none"),
                          ("#dddddd", "rgba(128,128,128,0.35)")):
        text = text.replace(plain, themed)
    text = re.sub(r'(id="|url\(#|href="#)', rf"\g<1>{name}-", text)  # several stand in one page
    return re.sub(r' (?:width|height)="[\d.]+pt"', "", text, count=2)


def over_time(drive: Drive, title: str, columns: list[str], unit: str, name: str) -> str:
    """Columns of Drive.frames; of a long drive means of neighbouring frames."""
    frames = drive.frames
    bins = (np.arange(len(frames)) * min(1, MOST_BINS / len(frames))).astype(int)
    means = frames[["time_s", *columns]].groupby(bins).mean()
    series = [{"x": means.time_s, "y": means[column], "color": LINES[column],
               **({"label": column} if len(columns) > 1 else {})} for column in columns]
    drawing = plots.lines(title, "seconds since the first frame", unit, series, ylim=(0, None),
                          legend={"loc": "upper left", "bbox_to_anchor": (1, 1)})
    drawing.set_size_inches(8, 3.4)
    return svg(drawing, name)


def directions(drive: Drive) -> str:
    """How often each of the 64 sectors was watched, ahead up."""
    drawing, axes = plt.subplots(subplot_kw={"projection": "polar"}, figsize=(5, 3.4))
    axes.set_theta_zero_location("N")
    middle = (np.arange(64) + 0.5) * math.tau / 64
    blind, blocked = drive.not_watched / drive.told, drive.blocked / drive.told
    def ring(lengths, begin, **style):  # a clip has another name in each run
        axes.bar(middle, lengths, math.tau / 64, begin, clip_on=False, **style)

    ring(1 - blind, 0, color="#2E86C1", alpha=0.75, label="watched")
    ring(blind, 1 - blind, color="#D55E00", label="blind")
    if blocked.any():
        ring(0.08 * (blocked > 0), 1.02, color="#000000", label="blocked at times")
    axes.set_xticks(np.radians(range(0, 360, 45)), [f"{i}°" for i in (0, 45, 90, 135, 180, -135, -90, -45)])
    axes.set(yticks=[], ylim=(0, 1.1 if blocked.any() else 1))
    axes.grid(False)
    axes.tick_params(pad=8)
    axes.legend(loc="upper left", bbox_to_anchor=(1.2, 1.1))
    return svg(drawing, "directions")


def _canvas(colours: np.ndarray, extent, size):
    """Dark in every theme, as the picture of `iog`."""
    drawing, axes = plt.subplots(figsize=size)
    axes.imshow(colours, origin="lower", extent=extent, interpolation="nearest")
    axes.grid(False)
    axes.set_facecolor(PLAIN)
    axes.tick_params(colors=WORDS, labelsize=12)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set(color=WORDS, fontsize=13)
    return drawing, axes


def _widened(cells: np.ndarray, order: np.ndarray) -> np.ndarray:
    """What is occupied is three cells wide, so that it is seen among free ones."""
    padded = np.pad(cells, 1)
    found = cells.copy()
    for y in range(3):
        for x in range(3):
            other = padded[y:y + cells.shape[0], x:x + cells.shape[1]]
            found = np.where((order[other] > order[found]) & (order[other] > 1), other, found)
    return found


def _ahead(grid: np.ndarray, cell_m: float, to_cells) -> np.ndarray:
    """Cells around the car, [forward, right]; what is outside of the grid is 0."""
    at = (np.arange(-REACH_M / cell_m, REACH_M / cell_m) + 0.5) * cell_m
    x, y = (np.floor(each).astype(int) for each in to_cells(at[:, None], -at[None, :]))
    x, y = np.broadcast_arrays(x, y)
    rows, columns = grid.shape
    inside = (np.minimum(x, y) >= 0) & (x < columns) & (y < rows)
    return np.where(inside, grid[np.clip(y, 0, rows - 1), np.clip(x, 0, columns - 1)], 0)


def _car_picture(colours: np.ndarray, title: str, footprint: dict):
    drawing, axes = _canvas(colours, (-REACH_M, REACH_M, -REACH_M, REACH_M), (5.4, 5.4))
    axes.set_title(title, color=WORDS, fontsize=13)
    axes.set_xticks(range(-REACH_M, REACH_M + 1, 20), [f"{abs(x)} m" for x in range(-REACH_M, REACH_M + 1, 20)])
    axes.set_yticks(range(-REACH_M, REACH_M + 1, 20), [f"{y} m" for y in range(-REACH_M, REACH_M + 1, 20)])
    x, y = ((footprint[f"{axis}_min_m"], footprint[f"{axis}_max_m"]) for axis in "xy")
    axes.add_patch(Polygon([(-y[0], x[0]), (-y[0], x[1]), (-y[1], x[1]), (-y[1], x[0])], facecolor="white",
                           edgecolor="black"))
    return drawing, axes


def index_picture(frame: Frame, time_s: float, footprint: dict) -> str:
    of = frame.geometry
    kinds = _ahead(np.sign(frame.indexes) % 3, of.cell_m, lambda x, y: ((x - of.x_m) / of.cell_m, (y - of.y_m) / of.cell_m))
    colours = np.array([NOTHING, HIT, PASSED], np.uint8)[_widened(kinds, np.array([0, 2, 1]))]
    drawing, _ = _car_picture(colours, f"Index grid at {time_s:.1f} s", footprint)
    return png(drawing)


def class_picture(frame: Frame, time_s: float, footprint: dict) -> str:
    colours = OF_CLASSES[_widened(_ahead(frame.classes, frame.window.geometry.cell_m, frame.window.to_cells), ORDER)]
    drawing, axes = _car_picture(colours, f"Classes at {time_s:.1f} s", footprint)
    for thing in (each for each in frame.objects or [] if each.state == State.MOVES):
        heading = thing.heading_rad or 0.0
        c, s = math.cos(heading), math.sin(heading)
        box = [(thing.x_m + c * a - s * b, thing.y_m + s * a + c * b) for a, b in (
            (i * thing.length_m / 2, j * thing.width_m / 2) for i, j in ((1, 1), (1, -1), (-1, -1), (-1, 1)))]
        places = [frame.window.from_local(*corner) for corner in (
            *box, (thing.x_m, thing.y_m), (thing.x_m + thing.vx_m_s, thing.y_m + thing.vy_m_s))]
        *corners, begin, end = [(-y, x) for x, y in places]
        axes.add_patch(Polygon(corners, fill=False, edgecolor="white", linewidth=1.2))
        axes.annotate("", end, begin, arrowprops={"arrowstyle": "->", "color": "white"})
    axes.set(xlim=(-REACH_M, REACH_M), ylim=(-REACH_M, REACH_M))
    return png(drawing)


def map_of(world: World, moved: list[Followed]) -> str:
    """The cells of the whole drive, the car's path in white and those of moving objects in magenta."""
    places = np.array(list(world.tiles))
    low, high = places.min(axis=0), places.max(axis=0) + 1
    step = min(32, 2 ** max(0, math.ceil(math.log2(32 * (high - low).max() / MAP_PIXELS))))  # cells of a pixel
    side = 32 // step
    cells = np.zeros(((high - low)[1] * side, (high - low)[0] * side), np.uint8)
    for (a, b), tile in world.tiles.items():
        shown = np.where(tile == Class.MOVING, Class.UNKNOWN, tile)  # it has gone on
        blocks = shown.reshape(side, step, side, step).swapaxes(1, 2).reshape(side, side, -1)
        top = np.take_along_axis(blocks, ORDER[blocks].argmax(axis=2)[..., None], axis=2)[..., 0]
        y, x = (b - low[1]) * side, (a - low[0]) * side
        cells[y:y + side, x:x + side] = top
    extent = [edge * 32 * world.cell_m for edge in (low[0], high[0], low[1], high[1])]
    wide, tall = (high - low) / (high - low).max()
    drawing, axes = _canvas(OF_CLASSES[cells if step > 1 else _widened(cells, ORDER)], extent,
                            (max(4, 9 * wide) + 0.8, max(2.5, 9 * tall) + 0.8))
    for each in (each for each in moved if each.world is world):
        axes.plot(*zip(*each.way), color="#FF28A0", linewidth=1)
    axes.plot(*zip(*world.way), color="white", linewidth=1.5)
    axes.set(xlabel="x in the poses' frame, m", ylabel="y, m", xlim=extent[:2], ylim=extent[2:])
    return png(drawing)
