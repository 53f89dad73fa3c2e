"""Tables as a template declares them."""

import unittest

import laboratory  # noqa: F401 ; it makes lab/pages known
import jinja2
import pandas
import rows

WALKS = pandas.DataFrame({"walk": ["a", "b"], "scene": ["city", "ring_road"], "found": [1, 30], "crossed": [2, 40]})


def rendered(template: str, **names) -> list[list[str]]:
    """The cells of the table, without its rule."""
    environment = jinja2.Environment(undefined=jinja2.StrictUndefined)
    environment.globals.update(rows=rows.rows, calc=rows.calc, each=rows.each)
    lines = environment.from_string(template).render(**names).splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in (lines[0], *lines[2:])]


class Rows(unittest.TestCase):
    def test_a_line_of_cells_is_filled_for_each_row(self):
        self.assertEqual(rendered("{% call rows(walks) %}\n| walk | scene | share |\n"
                                  "| {walk} | {scene}\n| {found / crossed:1%} |\n{% endcall %}", walks=WALKS),
                         [["walk", "scene", "share, %"], ["a", "city", "50.0"], ["b", "ring road", "75.0"]])

    def test_a_line_without_fields_stands_for_itself(self):
        self.assertEqual(rendered("{% call rows(walks, where='found > 1', twice='2 * found') %}\n| walk | twice |\n"
                                  "| paper | 9 |\n| {walk} | {twice} |\n{% endcall %}", walks=WALKS),
                         [["walk", "twice"], ["paper", "9"], ["b", "60"]])

    def test_rows_that_differ_in_one_column_are_merged(self):
        self.assertEqual(rendered("{% call rows(each(drive=['a', 'b'], share=[1, 2, 1]), merge=[1, 0]) %}\n"
                                  "| drive | name | share |\n| {drive} | s{share} | {share % 2} |\n{% endcall %}"),
                         [["drive", "name", "share"], ["a; b", "s1; s1", "1"], ["a; b", "s2", "0"]])

    def test_expressions_know_what_the_template_has_set(self):
        self.assertEqual(rendered("{% set half = calc('lambda value: value / 2') %}"
                                  "{% call rows(each(r=[1, 3], walk=['a'])) %}\n| r | half |\n| {r} | {half(r):2} |\n{% endcall %}"),
                         [["r", "half"], ["1", "0.50"], ["3", "1.50"]])

    def test_words_that_the_data_does_not_bear_out_are_no_page(self):
        rows.expect("1 is 1", True)
        with self.assertRaisesRegex(AssertionError, "a page says that 1 is 2"):
            rows.expect("1 is 2", False)

    def test_forms(self):
        for value, form, text in ((1048576, ",", "1,048,576"), (0.5, "1%", "50.0 %"), (4.65e-4, "2e", "4.65e-4"),
                                  (1.25, "1", "1.2"), (float("nan"), "1%", rows.NO_VALUE), (12, "", "12"),
                                  ("ring_road", "", "ring road"), ("ring_road", "s", "ring_road")):
            self.assertEqual(rows.formatted(value, form), text)

    def test_a_column_is_spread_over_columns_in_the_order_of_the_table(self):
        table = pandas.DataFrame({"choice": ["z", "z", "a", "a"], "class": ["free", "hit"] * 2, "cells": [1, 2, 3, 4]})
        self.assertEqual(rows.wide(table, "choice", "class").to_dict("list"),
                         {"choice": ["z", "a"], "cells_free": [1, 3], "cells_hit": [2, 4]})

    def test_rows_are_found_by_several_columns(self):
        self.assertEqual(rows.keyed(WALKS, "walk", "scene")["b", "ring_road"].found, 30)


if __name__ == "__main__":
    unittest.main()
