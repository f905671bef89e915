"""Checks a static site: every link, picture, script and style leads to a file of it, and every anchor to an element.
An anchor with `=` is none: the studio reads it.

Nothing is loaded from the web: a page would tell others who reads it, and break without them.
"""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, file: Path):
        super().__init__()
        self.anchors, self.links, self.loads = set(), [], []
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        elif tag in ("img", "script", "source", "iframe") and values.get("src"):
            self.loads.append(values["src"])
        elif tag == "link" and values.get("href") and values.get("rel") != "canonical":
            self.loads.append(values["href"])


def broken(site: Path) -> tuple:
    """What is broken, a line each, and the number of links that were checked."""
    site = site.resolve()
    pages = {file: Page(file) for file in sorted(site.rglob("*.html"))}
    faults, checked = [], 0
    for file, page in pages.items():
        if file.name == "404.html":  # its links are those of a server's root
            continue
        for target in page.links + page.loads:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                if target in page.loads and parts.scheme != "data":
                    faults.append(f"{file.relative_to(site)}: loads {target} from the web")
                continue
            checked += 1
            to = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if to.is_dir():
                to /= "index.html"
                if parts.path not in (".", "./") and file.parent / parts.path != to.parent:
                    faults.append(f"{file.relative_to(site)}: {target} leads to a folder")
            if not to.is_file() or site not in to.parents:
                faults.append(f"{file.relative_to(site)}: {target} leads nowhere")
            elif parts.fragment and "=" not in parts.fragment and to in pages and unquote(parts.fragment) not in pages[to].anchors:
                faults.append(f"{file.relative_to(site)}: {target}: no such heading")
    return faults, checked


if __name__ == "__main__":
    found, count = broken(Path(sys.argv[1]))
    print("\n".join(found + [f"{count} links, {len(found)} broken"]))
    sys.exit(1 if found else 0)
