"""How well a choice of the computation does, from the counts in lab/data/detection_quality*.csv."""

import dataclasses
from types import SimpleNamespace

from markdown import fixed, percent
from section import select

HITS_WIN = "hits_win (default)"
BAYES = "bayes"
SEQUENTIAL = "sequential"
DOUBLE = "Bayes in double"
POOL = "linear opinion pool"
MAXIMUM = "maximum policy"
NEAREST = "hits_win, nearest"


def share(part, whole) -> float:
    return part / whole if whole else 0.0


def both(exact: float, near: float) -> str:
    """52.6 / 86.3 %: exact, and with the tolerance of a cell."""
    return f"{fixed(100 * exact, 1)} / {percent(near, 1)}"


@dataclasses.dataclass(frozen=True)
class Score:
    """Of one class of cells, occupied or free."""

    visible: int
    found: int
    found_near: int
    called: int
    right: int
    right_near: int

    @property
    def recall(self):
        return share(self.found, self.visible)

    @property
    def recall_near(self):
        return share(self.found_near, self.visible)

    @property
    def precision(self):
        return share(self.right, self.called)

    @property
    def precision_near(self):
        return share(self.right_near, self.called)

    @property
    def wrong(self):
        return self.called - self.right


@dataclasses.dataclass(frozen=True)
class Ended:
    """What became of the cells in which beams ended."""

    occupied: int
    free: int
    unknown: int

    @property
    def all(self):
        return self.occupied + self.free + self.unknown

    @property
    def lost(self):
        return share(self.free, self.all)

    @property
    def left_unknown(self):
        return share(self.unknown, self.all)


@dataclasses.dataclass(frozen=True)
class Choice:
    """On the simulated drive."""

    name: str
    frames: int
    area: float  # under ROC
    occupied: Score
    free: Score
    missed_cells: int
    missed_near_cells: int
    ended: Ended

    @property
    def missed(self):
        return share(self.missed_cells, self.occupied.visible)

    @property
    def missed_near(self):
        return share(self.missed_near_cells, self.occupied.visible)

    @property
    def phantoms(self):
        """Mean of a frame."""
        return (self.occupied.called - self.occupied.right_near) / self.frames

    @property
    def known(self):
        """Of the visibly occupied and of the visibly free cells, the shares that it calls
        anything."""
        return SimpleNamespace(
            occupied=share(self.occupied.found + self.missed_cells, self.occupied.visible),
            free=share(self.free.found + self.occupied.wrong, self.free.visible))

    @property
    def false_alarms(self):
        """Of the visibly free cells, the share that it calls occupied."""
        return share(self.occupied.wrong, self.free.visible)

    def row(self):
        free_precision = (f"{fixed(100 * self.free.precision, 2)} / "
                          f"{percent(self.free.precision_near, 2)}")
        return [self.name, both(self.occupied.recall, self.occupied.recall_near),
                both(self.occupied.precision, self.occupied.precision_near),
                both(self.free.recall, self.free.recall_near), free_precision,
                fixed(self.area, 3), both(self.missed, self.missed_near), fixed(self.phantoms, 1),
                percent(self.ended.lost, 1)]

    def detects_better(self, other: "Choice") -> bool:
        """In all that weighs for an obstacle's sake."""
        return (self.occupied.recall > other.occupied.recall and self.area > other.area and
                self.missed < other.missed and self.ended.lost <= other.ended.lost)

    def against(self, other: "Choice") -> str:
        def pair(word, show):
            return f"{word} {show(self)} against {show(other)}"
        recall = pair("occupied recall",
                      lambda c: both(c.occupied.recall, c.occupied.recall_near))
        better = [recall, pair("area", lambda c: fixed(c.area, 3)),
                  pair("missed", lambda c: both(c.missed, c.missed_near)),
                  pair("hits lost", lambda c: percent(c.ended.lost, 1))]
        phantoms = pair("phantoms,", lambda c: fixed(c.phantoms, 1))
        return f"{', '.join(better)}; on the other side {phantoms} a frame"


def _score(classes, choice, name) -> Score:
    counts = select(classes, choice=choice, **{"class": name}).iloc[0]
    return Score(*(int(counts[f"{field.name}_cells"]) for field in dataclasses.fields(Score)))


def _ended(row) -> Ended:
    return Ended(row.ended_occupied_cells, row.ended_free_cells, row.ended_unknown_cells)


def on_drive(data) -> dict[str, Choice]:
    """By their names."""
    classes = data["detection_quality_classes"]
    return {row.choice: Choice(row.choice, row.frames, row.area_under_roc,
                               _score(classes, row.choice, "occupied"),
                               _score(classes, row.choice, "free"),
                               row.missed_cells, row.missed_near_cells, _ended(row))
            for row in data["detection_quality"].itertuples()}


def on_recordings(data) -> dict[str, SimpleNamespace]:
    """By their files' names: frames, and what became of the hits by each choice."""
    found = {}
    for name, rows in data["detection_quality_recordings"].groupby("recording", sort=False):
        found[name] = SimpleNamespace(
            frames=rows["frames"].iloc[0],
            ended={row.choice: _ended(row) for row in rows.itertuples()})
    return found
