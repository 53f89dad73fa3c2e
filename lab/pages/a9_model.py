"""The cost model of the Cortex-A9: its constants, and its answers where others know them."""

from section import Section

NEVER = 1_000_000_000  # so many lines are never written in a row


def _constants(table):
    return [[f"`{row.constant}`",
             *("never" if value == NEVER else value
               for value in (row.nominal, row.optimistic, row.pessimistic)),
             row.certainty, row.source] for row in table.itertuples(index=False)]


def _words(program):
    """l2_chain@page_kb=4 is "l2 chain, page_kb 4": a program with another constant."""
    name, _, option = program.partition("@")
    return name.replace("_", " ") + (f", {option.replace('=', ' ')}" if option else "")


def _answers(table):
    return [[_words(row.program), row.per_unit, f"{row.answer:g}", f"{row.modelled:.2f}",
             row.may_differ_by, row.kind, row.source] for row in table.itertuples(index=False)]


def section(data) -> Section:
    return Section(found={"constants": _constants(data["a9_constants"]),
                          "answers": _answers(data["a9_answers"])})
