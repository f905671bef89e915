"""What site/make.py and site/check.py do, without MkDocs."""
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import make
from check import broken

HEAD = '<a id="top" href="#top">up</a><a href="sub/page.html#here">a page</a><img src="ball.png">'


def site(folder, home):
    """A site of two pages and a picture."""
    root = Path(folder)
    (root / "sub").mkdir()
    (root / "index.html").write_text(home)
    (root / "sub/page.html").write_text('<h2 id="here">Here</h2><a href="../index.html">home</a>')
    (root / "ball.png").write_bytes(b"")
    return root


class Check(unittest.TestCase):
    def faults(self, more):
        with tempfile.TemporaryDirectory() as folder:
            return broken(site(folder, HEAD + more))

    def test_a_whole_site_has_no_fault(self):
        self.assertEqual(self.faults('<a href="https://example.org/">on the web</a>'), ([], 4))

    def test_a_page_may_get_options_behind_the_hash(self):
        self.assertEqual(self.faults('<a href="sub/page.html#scene=glass.ray">studio</a>'), ([], 5))

    def test_each_fault_is_found(self):
        for fault, words in (
            ('<a href="no.html">', "no.html leads nowhere"),
            ('<img src="no.png">', "no.png leads nowhere"),
            ('<a href="sub/page.html#there">', "no such heading"),
            ('<a href="#there">', "no such heading"),
            ('<a href="../outside.html">', "leads nowhere"),
            ('<script src="https://example.org/a.js"></script>', "from the web"),
            ('<link rel="stylesheet" href="//example.org/a.css">', "from the web"),
        ):
            faults, _ = self.faults(fault)
            self.assertEqual(len(faults), 1, fault)
            self.assertIn(words, faults[0])
            self.assertTrue(faults[0].startswith("index.html: "), faults[0])


class Pages(unittest.TestCase):
    def staged(self, text, name="docs/page.md"):
        stage = make.Stage()
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "page.md"
            file.write_text(text)
            return stage.page(file)

    def test_blocks_get_a_language(self):
        page = self.staged("Write:\n\n    Trace 1\n\n    sphere { }\n\nRender it:\n\n    ray a.ray\n")
        self.assertIn("```ray\nTrace 1\n\nsphere { }\n```\n", page)
        self.assertIn("```sh\nray a.ray\n```\n", page)

    def test_a_block_in_a_list_stays_in_it(self):
        self.assertIn("    ```sh\n    ray a.ray\n    ```\n", self.staged("* So:\n\n      ray a.ray\n\n* Or so.\n"))

    def test_a_table_may_follow_a_paragraph(self):
        self.assertIn("Fields:\n\n| a |\n", self.staged("Fields:\n| a |\n|---|\n| 1 |\n"))

    def test_three_pictures_become_a_slider(self):
        page = self.staged("![off](a.jpg)\n![on](b.jpg)\n![difference](c.jpg)\n")
        self.assertIn('<div class="triple"><img alt="off" loading="lazy" src="a.jpg">', page)

    def test_links_to_sources_lead_to_pages_that_show_them(self):
        stage, file = make.Stage(), make.ROOT / "docs/cpp.md"
        self.assertEqual(stage.links("[a](../examples/cpp) [b](../LICENSE) [c](python.md)", file),
                         "[a](../examples/cpp/index.md) [b](../LICENSE.md) [c](python.md)")
        self.assertEqual(len(stage.waiting), 2)

    def test_a_scene_leads_to_the_studio_where_it_was_made(self):
        link = "[Open it in the studio](../../studio/index.html#scene=tutorial/1-1.ray)"
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(make, "STUDIO", Path(folder)):
            self.assertIn(link, make.Stage.source(Path("scenes/tutorial/1-1.ray"), "Trace 1"))
            self.assertNotIn("studio", make.Stage.source(Path("scenes/tutorial/pieces.inc"), "Trace 1"))
            self.assertNotIn("studio", make.Stage.source(Path("examples/c/a.c"), ""))
        with mock.patch.object(make, "STUDIO", Path("/none")):
            self.assertNotIn("studio", make.Stage.source(Path("scenes/glass.ray"), "Trace 1"))

    def test_the_menu_has_every_page_of_the_index(self):
        menu = str(make.navigation())
        for _, page in make.LINK_WITH_LABEL.findall((make.ROOT / "docs/index.md").read_text()):
            self.assertIn("'" + os.path.normpath("docs/" + page) + "'", menu)


if __name__ == "__main__":
    unittest.main()
