"""Markdown that also reads well as text: numbers as tables show them, aligned tables, wrapped lines."""

import pathlib
import re
import textwrap
import unicodedata

import jinja2

LINE_CHARACTERS = 100
NUMBER = re.compile(r"[-+±−<≤≥]?\d[\d,.]*(e-?\d+)?( [^\s\d]{1,5})?|–|")
# A number, or two, with a unit: "≤ 550 Hz", "20.1 (20.4) ms", "0.3 to 2.2 m".
MEASURED = re.compile(r"((?:to\b|[^A-Za-z*])*\d(?:to\b|[^A-Za-z*])*) (%|Hz|ms|ns|m|s)")
# A line that begins with such a word would be a list, a heading, a quotation or a table.
MARK = re.compile(r"\d+[.)]|[>|].*|[-+*#=_]+")


def fixed(value: float, decimals: int) -> str:
    """0.604"""
    return f"{value:.{decimals}f}"


def scientific(value: float, decimals: int) -> str:
    """4.65e-4"""
    mantissa, exponent = f"{value:.{decimals}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def percent(share: float, decimals: int) -> str:
    """99.50 % of a share of 0.995"""
    return f"{100 * share:.{decimals}f} %"


def grouped(value: float) -> str:
    """1,048,576; a half goes to the even number"""
    return f"{value:,.0f}"


def width(text: str) -> int:
    """Columns of a terminal; a combining mark stands on the character before it."""
    return sum(not unicodedata.combining(letter) for letter in text)


def _with_unit_in_heading(column: list[str]) -> list[str]:
    """The heading and its cells: a unit that two or more of them share, and no other cell lacks, stands once."""
    heading, *cells = column
    found = [MEASURED.fullmatch(cell) for cell in cells if cell not in ("", "–")]
    units = {match and match[2] for match in found}
    if len(found) < 2 or len(units) != 1 or None in units:
        return column
    unit = units.pop()
    return [f"{heading}, {unit}" if heading else unit, *(cell.removesuffix(f" {unit}") for cell in cells)]


def table(columns: list[str], rows: list[list]) -> str:
    """A column whose cells all look like numbers is aligned to the right."""
    cells = [[str(cell).replace("|", r"\|").replace("\n", " ") for cell in row] for row in rows]
    assert all(len(row) == len(columns) for row in cells), f"a row does not fit {columns}"
    columns, *cells = map(list, zip(*map(_with_unit_in_heading, zip(columns, *cells))))
    is_right = [bool(cells) and any(row[i] for row in cells) and
                all(NUMBER.fullmatch(row[i]) for row in cells) for i in range(len(columns))]
    # A long last column is not padded: only its words would be moved apart.
    widths = [max(width(row[i]) for row in [columns, *cells]) for i in range(len(columns))]
    if widths[-1] > 40:
        widths[-1] = width(columns[-1])

    def line(row):
        padded = [" " * (w - width(cell)) + cell if right else cell + " " * (w - width(cell))
                  for cell, w, right in zip(row, widths, is_right)]
        return f"| {' | '.join(padded)} |"

    rule = "|".join("-" * (w + 1) + ":" if right else "-" * (w + 2)
                    for w, right in zip(widths, is_right))
    return "\n".join([line(columns), f"|{rule}|", *(line(row) for row in cells)])


def wrapped(text: str) -> str:
    """Paragraphs and items in lines of at most 100 characters; tables, headings, code and pictures
    as they are, with one empty line between blocks."""
    blocks = []
    for part in re.split(r"(^```.*?^```$)", text, flags=re.M | re.S):
        if part.startswith("```"):
            blocks.append(part)
        else:
            blocks += [block.strip("\n") for block in re.split(r"\n\s*\n", part) if block.strip()]
    return "\n\n".join(_wrapped_block(block) for block in blocks) + "\n"


def _wrapped_block(block: str) -> str:
    if block.startswith(("|", "#", "```", "![", "<", "    ")):
        return "\n".join(line.rstrip() for line in block.splitlines())
    pieces = re.split(r"^(?=- )", block.strip(), flags=re.M)
    return "\n".join(_lines(piece, "  " if piece.startswith("- ") else "")
                     for piece in pieces if piece)


def _lines(text: str, indent: str) -> str:
    words = text.split()
    # A word that would change the meaning of a line if it began one stays with the one before it.
    joined = words[:1]
    for word in words[1:]:
        if MARK.fullmatch(word):
            joined[-1] += "\0" + word
        else:
            joined.append(word)
    lines = textwrap.wrap(" ".join(joined), LINE_CHARACTERS, subsequent_indent=indent,
                          break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines).replace("\0", " ")


def rendered(template: pathlib.Path, **names) -> str:
    """The page that a template makes of these names, and of table() and grouped()."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(template.parent), undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True, autoescape=False)
    environment.globals.update(table=table, grouped=grouped)
    return wrapped(environment.get_template(template.name).render(**names))
