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
        return {name: zlib.decompress(data[4:]).decode() for name, data in rows if data}


class HelpTest(unittest.TestCase):
    def test_each_filter_is_described_with_its_properties(self):
        pages = pages_of(sys.argv[1])
        self.assertEqual(len(pages), len(sys.argv) - 2)
        for path in sys.argv[2:]:
            proxy = ElementTree.parse(path).find(".//*[@class]")
            page = html.unescape(pages[f"filters.{proxy.get('name')}.html"])
            self.assertIn(proxy.get("label"), page)
            for prop in proxy:
                if prop.tag.endswith("VectorProperty"):
                    self.assertIn(prop.get("label", prop.get("name")), page)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
