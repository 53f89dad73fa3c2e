"""Tables that a template declares: a line of headings and a line of cells, which is filled for each row of the data.

A cell has fields, {expression:form}. The expression is Python's, of the row's columns and of what the template has
set. The form is "3" for three decimals, "," for 1,048,576, "1%" for a share in per cent, "2e" for 4.65e-4, "b2" for
12.40 (16.00) of what the cost model says, or one of Python's. A text without a form is written by WORDS.
"""

import functools
import itertools
import math
import string
import types

import jinja2
import pandas

import markdown

NO_VALUE = "–"
# Names in tables of lab/data, as pages write them.
WORDS = {"ring_road": "ring road"}
BUILTINS = {function.__name__: function for function in (
    abs, all, any, dict, enumerate, float, getattr, int, len, list, map, max, min, next, range, round, set, sorted, str, sum, tuple, zip)}


def formatted(value, form: str = "") -> str:
    if isinstance(value, str):
        return format(value, form) if form else WORDS.get(value, value)
    if form.startswith("b"):
        return value.banded(int(form[1:]))
    if value != value:
        return NO_VALUE
    if form == ",":
        return markdown.grouped(value)
    if form.isdigit():
        return markdown.fixed(value, int(form))
    if form[:-1].isdigit() and form[-1] in "%e":
        return (markdown.percent if form[-1] == "%" else markdown.scientific)(value, int(form[:-1]))
    return format(value, form)


@functools.cache
def _compiled(expression: str):
    return compile(f"({expression})", expression, "eval")


def value_of(expression: str, names: dict):
    """The template is part of the program: its expressions are trusted like any other source."""
    return eval(_compiled(expression), {"__builtins__": BUILTINS, **names})


def filled(cell: str, names: dict) -> str:
    return "".join(text + ("" if field is None else formatted(value_of(field, names), form))
                   for text, field, form, _ in string.Formatter().parse(cell))


def each(**values) -> list[dict]:
    """A row for each combination."""
    return [dict(zip(values, combination)) for combination in itertools.product(*values.values())]


def share(part, whole) -> float:
    return part / whole if whole else math.nan


def wide(table: pandas.DataFrame, index: str, columns: str) -> pandas.DataFrame:
    """A row for each value of one column, with columns VALUE_NAME for each value of the other, in their order."""
    made = table.pivot(index=index, columns=columns).reindex(table[index].drop_duplicates())
    made.columns = ["_".join(map(str, names)) for names in made.columns]
    return made.reset_index()


def keyed(table: pandas.DataFrame, *columns: str) -> dict:
    """The rows, with their columns as attributes, by the values of a column or of several."""
    found = [types.SimpleNamespace(**row) for row in table.to_dict("records")]
    return {getattr(row, columns[0]) if len(columns) == 1 else tuple(getattr(row, name) for name in columns): row
            for row in found}


def records(data) -> list[dict]:
    """A row's values by name; what has no names is called `it`."""
    if isinstance(data, pandas.DataFrame):
        return data.to_dict("records")
    return [item if isinstance(item, dict) else {"it": item} for item in data]


def _lines(text: str) -> list[list[str]]:
    """The cells of each line; one that does not end with | goes on in the next."""
    joined = [""]
    for line in filter(None, map(str.strip, text.splitlines())):
        joined[-1] += f" {line}"
        if line.endswith("|"):
            joined.append("")
    return [[cell.strip() for cell in line.strip()[1:-1].split("|")] for line in joined if line]


def merged(cells: list[list[str]], column: int) -> list[list[str]]:
    """Rows that differ in this column alone become one row with all of its values."""
    found: dict[tuple, list[str]] = {}
    for row in cells:
        found.setdefault((*row[:column], *row[column + 1:]), []).append(row[column])
    return [[*others[:column], "; ".join(values), *others[column:]] for others, values in found.items()]


@jinja2.pass_context
def rows(context, data=({},), where: str = "True", merge=(), caller=None, **named: str) -> str:
    """{% call rows(data) %} headings, cells {% endcall %}. where: which rows. named: more names, by expressions.
    A line without a field stands for itself; with several lines of fields each is filled for all rows.
    merge: numbers of the columns by which rows are merged."""
    names, (headings, *patterns) = context.get_all(), _lines(caller())
    cells = []
    for pattern in patterns:
        is_filled = any("{" in cell for cell in pattern)
        for record in records(data) if is_filled else [{}]:
            known = {**names, **record}
            for name, expression in named.items() if is_filled else ():
                known[name] = value_of(expression, known)
            if not is_filled or value_of(where, known):
                cells.append([filled(cell, known) for cell in pattern])
    cells = functools.reduce(merged, merge, cells)
    return markdown.table(headings, cells) + "\n"  # of the line that ends with the block's end


def expect(words: str, is_so) -> None:
    """Words of a template that its data must bear out."""
    assert is_so, f"a page says that {words}, and its data does not"


@jinja2.pass_context
def calc(context, expression: str, **named):
    """The value of a Python expression of what the template has set."""
    return value_of(expression, {**context.get_all(), **named})
