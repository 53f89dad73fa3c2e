"""Tables 6.1 to 6.4 of Kurdej's thesis: as printed, by its printed equations, and as they are meant."""

from types import SimpleNamespace

from claims import Claim, Verdict
from markdown import fixed, scientific
from section import Section, one, select

SCHEMES = ["optimistic", "proportional", "conservative"]
SETS = {"1": "{1}", "2": "{2}", "12": "{1,2}", "3": "{3}", "13": "{1,3}", "23": "{2,3}",
        "frame": "Ω"}
# Table 6.1: what is left of a set, in the letters of the table, at alpha_1 = 0.3, alpha_23 = 0.2.
B1, B23 = 0.7, 0.8
HALVES = (1 - 0.3 / 2) * (1 - 0.2 / 2)
LEFT = {"empty": [B1 * B23] * 3, "1": [B1] * 3, "2": [B23] * 3, "12": [1, HALVES, B1 * B23],
        "3": [B23] * 3, "13": [1, HALVES, B1 * B23], "23": [B23] * 3}
# Tables 6.2 to 6.4, as printed, by scheme.
PRINTED = {
    6.2: {"1": ["0.5", "0.5", "0.5"], "3": ["0.5", "0.3", "0.3"], "frame": ["0.0", "0.2", "0.2"]},
    6.3: {"1": ["0.281"] * 3, "2": ["0.1"] * 3, "12": ["0.2", "0.1453125", "0.09375"],
          "3": ["0.034"] * 3, "frame": ["0.385", "0.440", "0.491"]},
    6.4: {"1": ["0.12771"] * 3, "2": ["0.1"] * 3, "12": ["0.2", "0.1069275", "0.04257"],
          "3": ["0.03376"] * 3, "frame": ["0.53853", "0.6316025", "0.69596"]},
}
PRINTED_CONTEXTUAL = {"1": "0.1723", "2": "0.1", "12": "0.1391", "3": "0.1662", "13": "0.15",
                      "23": "0.074", "frame": "0.1983"}
READINGS = ["printed equations", "kappa for alpha", "meant"]


def half_digit(printed):
    """Half a unit of the last digit that is printed, and a little for a half."""
    decimals = len(printed.partition(".")[2])
    return 0.5001 * 10.0 ** -decimals


class Tables:
    def __init__(self, data):
        self.data = data["evidential_discounting"]

    def mass(self, table, scheme, reading, name):
        return one(self.data, "mass", of_table=table, scheme=scheme, reading=reading, set=name)

    def total(self, table, scheme, reading):
        return select(self.data, of_table=table, scheme=scheme, reading=reading)["mass"].sum()

    def comparison_rows(self):
        return [[SETS[name], *(fixed(8 * self.mass(6.1, scheme, "meant", name), 4)
                               for scheme in SCHEMES),
                 *(fixed(8 * self.mass(6.1, scheme, "printed equations", name), 4)
                   for scheme in SCHEMES)] for name in SETS if name != "frame"]

    def largest_difference_to_table_61(self):
        return max(abs(8 * self.mass(6.1, scheme, "meant", name) - left[number])
                   for name, left in LEFT.items() for number, scheme in enumerate(SCHEMES))

    def rows(self, table, readings):
        return [[scheme, SETS[name], printed[number],
                 *(fixed(self.mass(table, scheme, reading, name), 6) for reading in readings)]
                for number, scheme in enumerate(SCHEMES)
                for name, printed in PRINTED[table].items()]

    def off_by(self, table, reading):
        """The cells of a printed table that are not what a reading gives, to the digits printed."""
        return sum(abs(self.mass(table, scheme, reading, name) - float(printed[number]))
                   > half_digit(printed[number])
                   for number, scheme in enumerate(SCHEMES)
                   for name, printed in PRINTED[table].items())

    def largest_off(self, table, reading):
        return max(abs(self.mass(table, scheme, reading, name) - float(printed[number]))
                   for number, scheme in enumerate(SCHEMES)
                   for name, printed in PRINTED[table].items())

    def contextual_rows(self):
        return [["contextual", SETS[name], printed,
                 "", "", fixed(self.mass(6.4, "contextual", "meant", name), 6)]
                for name, printed in PRINTED_CONTEXTUAL.items()]

    def contextual_is_printed(self):
        return all(abs(self.mass(6.4, "contextual", "meant", name) - float(printed))
                   <= half_digit(printed) for name, printed in PRINTED_CONTEXTUAL.items())

    def is_ordered(self):
        """Equation 6.38, of every set but the frame in every table as meant."""
        keys = self.data[(self.data["reading"] == "meant") & (self.data["set"] != "frame")]
        return all(self.mass(row.of_table, "optimistic", "meant", row.set) + 1e-15
                   >= self.mass(row.of_table, "proportional", "meant", row.set)
                   and self.mass(row.of_table, "proportional", "meant", row.set) + 1e-15
                   >= self.mass(row.of_table, "conservative", "meant", row.set)
                   for row in select(keys, scheme="optimistic").itertuples())


def _claims(tables):
    difference = tables.largest_difference_to_table_61()
    claims = [Claim("table 6.1", "what is left of every set", "products of 1 − α and 1 − α/2",
                    f"the same within {scientific(max(difference, 1e-15), 0)}", Verdict.EQUALS)]
    assert difference < 1e-12
    printed = 8 * tables.mass(6.1, "proportional", "printed equations", "12")
    claims.append(Claim(
        "equation 6.30", "what is left of {1,2}, proportional", fixed(printed, 4),
        fixed(8 * tables.mass(6.1, "proportional", "meant", "12"), 4), Verdict.DEPARTS,
        "table 6.1 has the other one; by the equation mass is lost even at α = 0"))
    total = tables.total(6.1, "conservative", "printed equations")
    claims.append(Claim("equations 6.20 to 6.22", "sum of all masses, conservative",
                        fixed(total, 4), fixed(tables.total(6.1, "conservative", "meant"), 4),
                        Verdict.DEPARTS, "what the sets lose is Ω's, as equation 6.19 begins"))
    off = tables.off_by(6.2, "meant")
    claims.append(Claim("table 6.2", "cells as printed", f"{9} of 9", f"{9 - off} of 9",
                        *((Verdict.EQUALS,) if off == 0 else
                          (Verdict.DEPARTS, "by equation 6.24 {r} lies in {h, r} and loses 0.4 also "
                                            "by the optimistic scheme"))))
    claims.append(Claim("tables 6.1 to 6.4", "equation 6.38: optimistic ≥ proportional ≥ "
                        "conservative", "for every set", "for every set", Verdict.EQUALS)
                  if tables.is_ordered() else
                  Claim("tables 6.1 to 6.4", "equation 6.38", "for every set", "not for all",
                        Verdict.FALLS_SHORT, "the tables below"))
    for table in (6.3, 6.4):
        claims.append(Claim(
            f"table {table}", "{1} of 0.3 after 4 s, conservative",
            PRINTED[table]["1"][2], fixed(tables.mass(table, "conservative", "meant", "1"), 5),
            Verdict.DEPARTS, "equations 6.68 and 6.69 put what is left in the place of what is lost: "
            f"so come out {15 - tables.off_by(table, 'kappa for alpha')} of 15 cells, the others "
            f"within {scientific(tables.largest_off(table, 'kappa for alpha'), 0)}"))
    claims.append(Claim("table 6.4", "contextual discounting", "7 cells", "the same 7",
                        Verdict.EQUALS) if tables.contextual_is_printed() else
                  Claim("table 6.4", "contextual discounting", "7 cells", "not all",
                        Verdict.FALLS_SHORT, "the table below"))
    return claims


def section(data) -> Section:
    tables = Tables(data)
    return Section(
        found={"comparison": tables.comparison_rows(),
               "targets": tables.rows(6.2, ["printed equations", "meant"]),
               "case_1": tables.rows(6.3, READINGS),
               "case_2": tables.rows(6.4, READINGS) + tables.contextual_rows(),
               "kappa": SimpleNamespace(
                   off_1=tables.off_by(6.3, "kappa for alpha"),
                   off_2=tables.off_by(6.4, "kappa for alpha"),
                   most_2=tables.largest_off(6.4, "kappa for alpha")),
               "left_1": tables.mass(6.3, "conservative", "meant", "1") / 0.3,
               "printed_left_1": float(PRINTED[6.3]["1"][2]) / 0.3,
               "total": tables.total(6.1, "conservative", "printed equations")},
        claims=_claims(tables))
