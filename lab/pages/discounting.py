"""Tables 6.1 to 6.4 of Kurdej's thesis: as printed, by its printed equations, and as they are meant."""

from tables import one, select

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

    def largest_difference_to_table_61(self):
        return max(abs(8 * self.mass(6.1, scheme, "meant", name) - left[number])
                   for name, left in LEFT.items() for number, scheme in enumerate(SCHEMES))

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
