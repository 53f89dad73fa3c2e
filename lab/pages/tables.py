"""The tables of lab/data, and sums over rows of them."""

import functools
import math
import pathlib

import pandas

DATA = pathlib.Path(__file__).resolve().parents[1] / "data"


@functools.cache
def _table(path: pathlib.Path) -> pandas.DataFrame:
    return pandas.read_csv(path, keep_default_na=False, float_precision="round_trip")


class Data:
    """The tables of lab/data, by their file's name without ".csv", and which of its files were read."""

    def __init__(self, folder: pathlib.Path = DATA):
        self.folder = folder
        self.read: set[str] = set()

    def path(self, file: str) -> pathlib.Path:
        self.read.add(file)
        return self.folder / file

    def __getitem__(self, name: str) -> pandas.DataFrame:
        return _table(self.path(f"{name}.csv"))


def one(table: pandas.DataFrame, column: str, **where):
    """The value of a column in the one row that has these values in others."""
    rows = select(table, **where)
    assert len(rows) == 1, f"{len(rows)} rows have {where}"
    return rows.iloc[0][column]


def select(table: pandas.DataFrame, **where) -> pandas.DataFrame:
    """The rows that have these values; a list stands for any of its own, None for all."""
    for column, value in where.items():
        if value is not None:
            table = table[table[column].isin(value) if isinstance(value, (list, tuple)) else table[column] == value]
    return table


def total(table: pandas.DataFrame, columns, **where):
    """The sum of a column, or of several, over the rows that have these values."""
    return select(table, **where)[columns].to_numpy().sum()


def ratio(table: pandas.DataFrame, part, whole, **where) -> float:
    """Of two such sums; no number where the second is 0."""
    of_all = total(table, whole, **where)
    return total(table, part, **where) / of_all if of_all else math.nan
