#!/usr/bin/env python3
"""Makes the static site from the pages of the repository: `./dev site` calls it.

Three steps: the pages are staged, so that MkDocs reads them as GitHub does; MkDocs with the theme Material makes
the site; every link and picture of the site is checked. The navigation is that of docs/index.md.
"""
import html
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from check import broken

ROOT = Path(__file__).resolve().parent.parent
STAGE, SITE = ROOT / "build/site-pages", ROOT / "build/site"
STUDIO = ROOT / "build/web/page"  # what ./dev web makes; the pages of scenes link it
PAGES_IN = ["docs", "scenes", "examples", "editors"]  # the folders whose pages and pictures are shown
PICTURES = {".png", ".jpg", ".svg"}
SCENES = {".ray", ".pov", ".wrl", ".iv", ".out", ".obj"}  # what the studio opens from the page of a file
LINK = re.compile(r"\]\(([^)\s]+)\)")
LINK_WITH_LABEL = re.compile(r"\[([^\]]+)\]\(([^)#\s]+\.md)\)")
TRIPLE = re.compile(r"!\[off\]\((.+)\)\n!\[on\]\((.+)\)\n!\[difference\]\((.+)\)\n")
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".inc": "ray", ".ray": "ray", ".py": "python", ".sh": "sh", ".json": "json"}


def language_of(code: str) -> str:
    """The language of a block of code, by what only that language has."""
    if re.search(r"#include|traceray::|^\s*(auto|double|float) ", code, re.M):
        return "cpp"
    if re.search(r"^(import|from) |\btr\.|^\s*(picture|scene|ball)\.\w+|print\(", code, re.M):
        return "python"
    if re.match(r"(ray|\./dev|cmake|ffmpeg|sudo|apt|PYTHONPATH|pkg-config|build/)\b", code) or code.startswith("./dev"):
        return "sh"
    if re.match(r"(Trace 1|SBT-raytracer)", code) or re.search(r"^\s*(let|define|for) |\{ ?|\b\w+ = .*;", code, re.M):
        return "ray"
    return "text"


def fenced(code: list, in_list: bool) -> list:
    """An indented block as a fenced one, which has a language."""
    margin = min(len(line) - len(line.lstrip()) for line in code if line.strip()) if in_list else 4
    indent = "    " if in_list else ""
    code = [line[margin:] for line in code]
    return [indent + line for line in ["```" + language_of("\n".join(code)), *code, "```"]]


class Stage:
    """The pages as MkDocs gets them, below STAGE, each where it lies in the repository."""

    def __init__(self):
        self.waiting = []  # pages that links ask for: of files that are no Markdown, and of folders
        self.done = set()

    def all(self):
        shutil.rmtree(STAGE, ignore_errors=True)
        pages = sorted(ROOT.glob("*.md"))
        for folder in PAGES_IN:
            pages += sorted((ROOT / folder).rglob("*.md"))
        for page in pages:
            self.write(page.relative_to(ROOT), self.page(page))
        for folder in PAGES_IN:
            for picture in (ROOT / folder).rglob("*"):
                if picture.suffix in PICTURES:
                    self.copy(picture.relative_to(ROOT))
        self.waiting += sorted((ROOT / "scenes").glob("*.*")) + [ROOT / "scenes"]
        while self.waiting:
            self.extra(self.waiting.pop())
        shutil.copytree(ROOT / "site/files", STAGE / "site")
        if STUDIO.is_dir():
            shutil.copytree(STUDIO, STAGE / "studio")

    def write(self, path: Path, text: str):
        (STAGE / path).parent.mkdir(parents=True, exist_ok=True)
        (STAGE / path).write_text(text)

    def copy(self, path: Path):
        (STAGE / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / path, STAGE / path)

    def page(self, file: Path) -> str:
        out, code, fence, before = [], [], False, ""
        for line in file.read_text().splitlines() + [""]:
            if line.lstrip().startswith("```"):
                fence = not fence
            is_code = not fence and line.startswith("    ") and line.strip() and (code or not before.strip())
            if is_code or (code and not line.strip() and not fence):
                code.append(line)
            else:
                out += self.block(out, code)
                code = []
                # GitHub lets a table follow a paragraph at once.
                if line.startswith("|") and before.strip() and not before.startswith("|"):
                    out.append("")
                out.append(line if fence else self.links(line, file))
            before = line
        out += self.block(out, code)
        return self.pictures("\n".join(out) + "\n", file)

    @staticmethod
    def block(before: list, code: list) -> list:
        if not code:
            return []
        blank = 0
        while not code[-1].strip():
            code.pop()
            blank += 1
        prose = next((line for line in reversed(before) if line.strip()), "")
        in_list = code[0].startswith("      ") and re.match(r"(\*|\d+\.) |  ", prose) is not None
        return fenced(code, in_list) + [""] * blank

    def links(self, line: str, file: Path) -> str:
        """Links to files that are no pages lead to the pages that show them."""

        def shown(match):
            target, _, part = match[1].partition("#")
            to = file.parent / target
            if ":" in target or not target or not to.exists() or to.suffix in PICTURES | {".md"}:
                return match[0]
            self.waiting.append(to.resolve())
            return f"]({target.rstrip('/')}{'/index' if to.is_dir() else ''}.md{'#' + part if part else ''})"

        return LINK.sub(shown, line)

    def pictures(self, text: str, file: Path) -> str:
        """Triples of the features become sliders, and pictures of the gallery lead to their scenes."""

        def triple(match):
            names = zip(("off", "on", "difference"), match.groups())
            return '<div class="triple">' + "".join(f'<img alt="{n}" loading="lazy" src="{s}">' for n, s in names) + "</div>\n"

        def framed(match):
            name = Path(match[2]).stem
            scene = next(iter(sorted((ROOT / "scenes").glob(name + ".*"))), None)
            return f"[![{match[1]}]({match[2]})](../scenes/{scene.name}.md)" if scene else match[0]

        if file == ROOT / "docs/gallery.md":
            text = re.sub(r"^!\[(.*)\]\((gallery/.*)\)$", framed, text, flags=re.M)
        return TRIPLE.sub(triple, text)

    def extra(self, path: Path):
        """The page of a file that is no Markdown, or of a folder."""
        path = path.relative_to(ROOT)
        if path in self.done or path.suffix in PICTURES | {".md"}:
            return
        self.done.add(path)
        if (ROOT / path).is_dir():
            self.folder(path)
            return
        self.copy(path)  # to download
        text = (ROOT / path).read_text()
        body = notebook(text) if path.suffix == ".ipynb" else self.source(path, text)
        self.write(Path(f"{path}.md"), f"# {path.name}\n\n{body}\n")

    @staticmethod
    def source(path: Path, text: str) -> str:
        shown, more, up = "", "", "../" * (len(path.parts) - 1)
        if path.parts[0] == "scenes":
            for name in (f"docs/gallery/{path.stem}.jpg", f"docs/gallery/{path.stem}.png"):
                if (STAGE / name).exists():
                    shown = f"![{path.stem}]({up}{name})\n\n"
            if STUDIO.is_dir() and path.suffix in SCENES:
                more = f" · [Open it in the studio]({up}studio/index.html#scene={path.relative_to('scenes')})"
        return f"{shown}[The file]({path.name}) as it is{more}\n\n```{LANGUAGES.get(path.suffix, 'text')}\n{text.rstrip()}\n```"

    def folder(self, path: Path):
        files = [f for f in sorted((ROOT / path).iterdir()) if f.suffix not in PICTURES and not f.is_dir()]
        self.waiting += files
        lines = [f"* [{f.name}]({f.name if f.suffix == '.md' else f.name + '.md'})" for f in files]
        self.write(path / "index.md", f"# {path.name.capitalize()}\n\n" + "\n".join(lines) + "\n")


def notebook(text: str) -> str:
    """The cells of a Jupyter notebook, without their output."""
    cells = []
    for cell in json.loads(text)["cells"]:
        source = "".join(cell["source"])
        cells.append(f"```python\n{source}\n```" if cell["cell_type"] == "code" else re.sub(r"^#", "##", source))
    return "\n\n".join(cells)


def navigation() -> list:
    """The sections of docs/index.md, and in them its columns or its rows."""
    text = (ROOT / "docs/index.md").read_text()
    nav = [{"Home": "README.md"}]
    for section in re.split(r"^## ", text, flags=re.M)[1:]:
        title, _, body = section.partition("\n")
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in body.splitlines() if line.startswith("|")]
        groups = {"": [line for line in body.splitlines() if not line.startswith("|")]}
        if rows and title == "How-to":  # a column is a subject
            for column, name in enumerate(rows[0]):
                groups[name] = [row[column] for row in rows[2:]]
        else:  # a row is a subject
            for row in rows[2:]:
                groups[row[0]] = row[1:]
        entries = []
        for name, lines in groups.items():
            links = [{capital(label): os.path.normpath("docs/" + page)} for label, page in LINK_WITH_LABEL.findall("\n".join(lines))]
            entries += [{capital(name): links}] if name and links else links
        nav.append({title: entries})
    nav[-1][title].append({"All pages": "docs/index.md"})
    return nav


def capital(text: str) -> str:
    text = text.replace("`", "").removesuffix(".md")
    return text[:1].upper() + text[1:]


def configuration() -> Path:
    """JSON, which is YAML too."""
    file = STAGE.parent / "site.yml"
    file.write_text(json.dumps({
        "INHERIT": str(ROOT / "site/mkdocs.yml"), "docs_dir": str(STAGE), "site_dir": str(SITE),
        "hooks": [str(ROOT / "site/lexer.py")], "theme": {"custom_dir": str(ROOT / "site/theme")}, "nav": navigation()}))
    return file


def searchable_from_a_folder():
    """The index of the search as a script, which a browser loads without a server too."""
    index = json.loads((SITE / "search/search_index.json").read_text())
    for entry in index["docs"]:
        shown = ROOT / entry["location"].partition("#")[0].removesuffix(".html")
        if shown.suffix in LANGUAGES and shown.is_file():
            entry["text"] = html.escape(opening(shown.read_text()))
    (SITE / "search/search_index.js").write_text(f"traceSearchIndex({json.dumps(index)})\n")
    (SITE / "search/search_index.json").unlink()


def opening(source: str) -> str:
    """The comment that a source file or a scene begins with: what one would search it by."""
    words = []
    for line in source.splitlines():
        comment = re.match(r"\s*//+ ?(.*)", line)
        if comment:
            words.append(comment[1])
        elif words:
            break
    return " ".join(words)


def main() -> int:
    Stage().all()
    print("making build/site", file=sys.stderr)
    if subprocess.run(["mkdocs", "--quiet", "build", "--strict", "--clean", "-f", configuration()]).returncode:
        return 1
    searchable_from_a_folder()
    faults, links = broken(SITE)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(list(SITE.rglob('*.html')))} pages, {links} links and pictures, {len(faults)} broken", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
