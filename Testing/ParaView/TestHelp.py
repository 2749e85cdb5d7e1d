# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin brings a page of help for each filter: TestHelp.py HELP_FILE FILTER_XML..."""

import contextlib
import html
import re
import sqlite3
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zlib


class HelpTest(unittest.TestCase):
    def setUp(self):
        """The texts of a compiled help file of Qt, which is a database, by name."""
        with contextlib.closing(sqlite3.connect(sys.argv[1])) as database:
            rows = database.execute("SELECT Name, Data FROM FileNameTable JOIN FileDataTable ON FileId = Id")
            # Behind the length, of four bytes.
            self.pages = {name: zlib.decompress(data[4:]) for name, data in rows if data}

    def test_each_filter_is_described_with_its_properties(self):
        self.assertEqual(len([name for name in self.pages if name.endswith(".html")]), len(sys.argv) - 2)
        for path in sys.argv[2:]:
            proxy = ElementTree.parse(path).find(".//*[@class]")
            page = html.unescape(self.pages[f"filters.{proxy.get('name')}.html"].decode())
            for element in proxy:
                if element.tag.endswith("VectorProperty"):
                    self.assertIn(element.get("label", element.get("name")), page)
            self.assertIn(proxy.get("label"), page)

    def test_each_page_has_a_picture(self):
        """Of the filter itself, but one for all that make isosurfaces."""
        pictures = {}
        for name, page in self.pages.items():
            if name.endswith(".html"):
                (pictures[name],) = re.findall(r'<img src="([^"]+)"[^>]*/><br/><i>[A-Z][^<]+\.</i>', page.decode())
                self.assertTrue(self.pages[pictures[name]].startswith(b"\x89PNG"), name)
        for name in ("Slice", "Probe", "Line", "Grid", "Gradient", "Body"):
            self.assertEqual(pictures[f"filters.Scattered{name}.html"], f"filters_{name.lower()}.png")

    def test_pages_of_isosurfaces_have_headings(self):
        for name in ("ScatteredIsopoints", "ScatteredIsosurface"):
            page = self.pages[f"filters.{name}.html"].decode()
            for mark, least in (
                    ('<img src="comparison.png"', 1), ("<i>A sphere from a million random samples.", 1),
                    ("<p>", 5), ("<h3>When points, when triangles</h3>", 1)):
                self.assertGreaterEqual(page.count(mark), least, mark)
            self.assertNotIn("**", page)
            self.assertRegex(page, r"(?s)Clip\b.*Scattered\s+Isosurface" if "points" in name else "Slice and Clip")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
