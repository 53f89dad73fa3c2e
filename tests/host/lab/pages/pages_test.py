"""The pages as they stand in docs/: a reader who clicks arrives somewhere."""

import re
import unittest

import laboratory

DOCS = laboratory.ROOT / "docs"


def anchors_of(page):
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Links(unittest.TestCase):
    def test_every_anchor_is_a_heading(self):
        missing = []
        for page in sorted(DOCS.rglob("*.md")):
            for link in re.findall(r"\]\(([^):]*#[^)]+)\)", page.read_text()):
                name, anchor = link.split("#")
                if anchor not in anchors_of(page.parent / name if name else page):
                    missing.append(f"{page.name}: {link}")
        self.assertEqual(missing, [])

    def test_the_overview_leads_to_every_question_and_each_leads_back(self):
        overview = (DOCS / "results.md").read_text()
        for page in sorted((DOCS / "results").glob("*.md")):
            self.assertIn(f"](results/{page.name})", overview)
            self.assertIn("](../results.md)", page.read_text())


if __name__ == "__main__":
    unittest.main()
