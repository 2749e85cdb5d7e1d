# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin brings a page of help for each filter: TestHelp.py HELP_FILE FILTER_XML..."""

import contextlib
import html
import sqlite3
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zlib


def pages_of(path):
    """The texts of a compiled help file of Qt, which is a database, by name."""
    with contextlib.closing(sqlite3.connect(path)) as database:
        rows = database.execute(
            "SELECT Name, Data FROM FileNameTable JOIN FileDataTable ON FileId = Id")
        # Behind the length, of four bytes.
        return {name: zlib.decompress(data[4:]) for name, data in rows if data}


class HelpTest(unittest.TestCase):
    def test_each_filter_is_described_with_its_properties(self):
        pages = pages_of(sys.argv[1])
        self.assertEqual(len([name for name in pages if name.endswith(".html")]), len(sys.argv) - 2)
        for path in sys.argv[2:]:
            proxy = ElementTree.parse(path).find(".//*[@class]")
            page = html.unescape(pages[f"filters.{proxy.get('name')}.html"].decode())
            self.assertIn(proxy.get("label"), page)
            for prop in proxy:
                if prop.tag.endswith("VectorProperty"):
                    self.assertIn(prop.get("label", prop.get("name")), page)

    def test_pages_have_headings_and_a_picture(self):
        pages = pages_of(sys.argv[1])
        self.assertTrue(pages["comparison.png"].startswith(b"\x89PNG"))
        for name in ("ScatteredIsopoints", "ScatteredIsosurface"):
            page = pages[f"filters.{name}.html"].decode()
            self.assertIn('<img src="comparison.png"', page)
            self.assertIn("<h3>When points, when triangles</h3>", page)
            self.assertGreater(page.count("<p>"), 4)
            self.assertNotIn("**", page)
            self.assertRegex(page, r"(?s)Clip\b.*Scattered\s+Isosurface" if "points" in name else "Slice and Clip")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
