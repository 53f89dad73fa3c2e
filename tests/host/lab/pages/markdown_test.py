"""Numbers, tables and lines of the pages."""

import unittest

import laboratory  # noqa: F401 ; it makes lab/pages known
import markdown


class Numbers(unittest.TestCase):
    def test_have_the_decimals_that_are_asked_for(self):
        self.assertEqual(markdown.fixed(0.6039, 3), "0.604")
        self.assertEqual(markdown.percent(0.99501, 2), "99.50 %")

    def test_scientific_has_no_idle_digit_in_the_exponent(self):
        self.assertEqual(markdown.scientific(0.000465, 2), "4.65e-4")
        self.assertEqual(markdown.scientific(1e-11, 0), "1e-11")

    def test_grouped_has_a_comma_after_every_three_digits_and_no_decimals(self):
        self.assertEqual(markdown.grouped(1048576), "1,048,576")
        self.assertEqual(markdown.grouped(999.6), "1,000")
        self.assertEqual(markdown.grouped(-1234.4), "-1,234")

    def test_grouped_rounds_a_half_to_the_even_number(self):
        self.assertEqual(markdown.grouped(2.5), "2")
        self.assertEqual(markdown.grouped(-3.5), "-4")


class Table(unittest.TestCase):
    def test_numbers_stand_to_the_right_and_words_to_the_left(self):
        self.assertEqual(markdown.table(["stage", "mean"], [["mark", "7"], ["send", "1,234"]]),
                         "| stage |  mean |\n"
                         "|-------|------:|\n"
                         "| mark  |     7 |\n"
                         "| send  | 1,234 |")

    def test_a_bar_in_a_cell_does_not_end_it(self):
        self.assertIn(r"| a \| b |", markdown.table(["x"], [["a | b"]]))

    def test_a_row_of_another_length_is_refused(self):
        with self.assertRaises(AssertionError):
            markdown.table(["one", "two"], [["alone"]])

    def test_a_unit_that_all_cells_share_stands_in_the_heading(self):
        made = markdown.table(["share", "a", "", "b"], [["≤ 50.0 %", "3 ms", "12.4 (16.0) Hz", "2.0 to 2.5 m"],
                                                        ["", "4 s", "10 Hz", "3 m"], ["7 %", "–", "8 Hz", "5 m"]])
        headings, _, first, *_ = ([cell.strip() for cell in line.split("|")[1:-1]] for line in made.splitlines())
        self.assertEqual(headings, ["share, %", "a", "Hz", "b, m"])
        self.assertEqual(first, ["≤ 50.0", "3 ms", "12.4 (16.0)", "2.0 to 2.5"])

    def test_a_unit_of_one_cell_or_of_words_stays(self):
        self.assertIn("7 %", markdown.table(["x"], [["7 %"]]))
        self.assertIn("cells of 2 m", markdown.table(["x"], [["cells of 1 m"], ["cells of 2 m"]]))

    def test_a_combining_mark_takes_no_room(self):
        self.assertEqual(markdown.width("a\u0304b"), 2)


class Wrapping(unittest.TestCase):
    def test_no_line_of_a_paragraph_is_longer_than_100_characters(self):
        text = markdown.wrapped("word " * 60)
        self.assertTrue(all(len(line) <= 100 for line in text.splitlines()))
        self.assertEqual(text.split(), ["word"] * 60)

    def test_a_line_never_begins_with_what_would_make_it_something_else(self):
        """A paragraph's "- 3" at a line's beginning would be an item."""
        for word in ("-", ">", "1.", "#", "+"):
            text = markdown.wrapped("x" * 97 + f" {word} 3 more")
            self.assertFalse(any(line.startswith(f"{word} ") for line in text.splitlines()), word)

    def test_items_are_indented_and_stay_items(self):
        text = markdown.wrapped("- " + "one " * 40 + "\n- two")
        lines = text.splitlines()
        self.assertTrue(lines[0].startswith("- one"))
        self.assertTrue(lines[1].startswith("  one"))
        self.assertEqual(lines[-1], "- two")

    def test_tables_headings_and_code_are_left_alone(self):
        for block in ("| " + "x" * 120 + " |", "# " + "word " * 30 + "end",
                      "```sh\nfirst\n\nsecond\n```"):
            self.assertEqual(markdown.wrapped(block), f"{block}\n")

    def test_blocks_are_one_empty_line_apart(self):
        self.assertEqual(markdown.wrapped("# A\n\n\n\ntext\n\n| x |\n"), "# A\n\ntext\n\n| x |\n")


if __name__ == "__main__":
    unittest.main()
