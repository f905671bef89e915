"""Writes the stub file of the package from the lists of fields. Usage: make_stubs.py OUT.pyi"""

import sys

del sys.path[0]  # this folder, whose package lacks the compiled part
import traceray as tr

NUMBER, VECTOR, COLOR = "float", "Sequence[float]", "float | Sequence[float] | Node"
TYPES = {"switch": "bool", "whole number": "int", "number": NUMBER, "text": "str", "vector": VECTOR, "color": COLOR,
         "file": "File", "formula": "str", "choice": "str", "list": "Sequence[Any] | NDArray[Any]",
         "objects": "Sequence[Node]", "materials": "Sequence[Node]", "choices": "str | Sequence[str]",
         "region": "str | Sequence[int]", "place": "str | Sequence[float]"}
MORE = {"name": "str", "material": "Node | str | Part", "library": "str", "scale": "float | Sequence[float]",
        "rotate": VECTOR, "translate": VECTOR, "transform": "Sequence[Sequence[float]] | NDArray[Any]"}

HEAD = '''"""Made by make_stubs.py from the lists of fields."""

from os import PathLike
from typing import Any, Callable, Iterator, Sequence

from numpy.typing import NDArray
import numpy as np

File = str | PathLike[str]
Picture = NDArray[np.float32]
OnProgress = Callable[[float, float], bool | None] | None
__version__: str

class Problem:
    file: str
    line: int
    column: int
    is_error: bool
    what: str
    hint: str
    check: str

class Error(Exception):
    kind: str
    problems: list[Problem]

class Interrupted(KeyboardInterrupt):
    render: Render

class FieldInfo:
    name: str
    type: str
    unit: str
    least: float
    most: float
    help: str
    choices: list[str]
    usual: Any

class Kind:
    category: str
    keyword: str
    help: str
    fields: list[FieldInfo]

class Node:
    keyword: str
    def __init__(self, keyword: str, *arguments: Any, **fields: Any) -> None: ...
    @property
    def fields(self) -> dict[str, Any]: ...
    def replace(self, **fields: Any) -> Node: ...

class Part:
    category: str
    keyword: str
    name: str
    material: Any
    transform: NDArray[np.float64]
    @property
    def fields(self) -> dict[str, Any]: ...
    def set(self, **fields: Any) -> None: ...
    def move(self, *, scale: float | Sequence[float] = ..., rotate: Sequence[float] = ..., translate: Sequence[float] = ..., transform: Any = ...) -> None: ...
    def node(self) -> Node: ...
    def remove(self) -> None: ...
    def __getattr__(self, field: str) -> Any: ...
    def __setattr__(self, field: str, value: Any) -> None: ...

class Render:
    width: int
    height: int
    finished: bool
    end: str
    seconds: float
    rays: int
    warnings: list[Problem]
    image: Picture
    shown: Picture
    passes: dict[str, Picture]
    def __array__(self, dtype: Any = ...) -> Picture: ...
    def write(self, file: File) -> str: ...
    def png(self) -> bytes: ...
    def _repr_png_(self) -> bytes: ...
    def explain(self, x: int, y: int, sample: int = 0) -> dict[str, Any]: ...
    def explain_text(self, x: int, y: int, sample: int = 0) -> str: ...

class Difference:
    same_size: bool
    identical: bool
    unit: str
    metrics: dict[str, float]
    worst: tuple[int, int]
    heat: Picture
    def __getitem__(self, metric: str) -> float: ...
    def keys(self) -> list[str]: ...

class Grade:
    name: str
    file: str
    verdict: str
    passed: bool
    problem: str
    cause: str
    unit: str
    width: int
    height: int
    metrics: dict[str, float]

class Grades:
    pictures: list[Grade]
    extra: list[str]
    passed: int
    stopped: str
    def __len__(self) -> int: ...
    def __getitem__(self, name: str) -> Grade: ...
    def __iter__(self) -> Iterator[Grade]: ...
'''

TAIL = '''
def open(file: File, **options: Any) -> Scene: ...
def kinds() -> list[Kind]: ...
def options() -> list[FieldInfo]: ...
def diff(reference: Any, test: Any, tolerance: float = 0) -> Difference: ...
def grade(folder: File, reference: File, progress: OnProgress = None, *, render: bool = False,
          limits: dict[str, float] | str | Sequence[str] | None = None, tolerance: float = 0, page: File | None = None,
          strict: bool = False, scene_limit: float = 0, **options: Any) -> Grades: ...
def read(file: File) -> Picture: ...
def write(file: File, image: Any) -> None: ...
def settings(**options: Any) -> Node: ...
'''


def indented(text, margin):
    return ("\n" + margin).join(text.replace("\\", "\\\\").splitlines()).replace("\n" + margin + "\n", "\n\n")


def function(kind, margin=""):
    types = {name: TYPES[field.type] for field, (name, _, _) in zip(kind.fields, tr.parameters(kind))}
    arguments = ["*objects: Node"] if tr.takes_objects(kind) else ["*"]
    for name, _, _ in tr.parameters(kind):
        if not (tr.takes_objects(kind) and name == "objects"):
            arguments.append(f"{name}: {types.get(name) or MORE[name]} = ...")
    static = "" if not margin else margin + "@staticmethod\n"
    return (f'{static}{margin}def {kind.keyword}({", ".join(arguments)}) -> Node:\n'
            f'{margin}    """{indented(tr.docstring(kind), margin + "    ")}\n{margin}    """\n')


def scene_class():
    options = "".join(f", {o.name.replace('-', '_')}: {TYPES[o.type]} = ..." for o in tr.options())
    return f'''
class Scene:
    warnings: list[Problem]
    objects: list[Part]
    lights: list[Part]
    materials: list[Part]
    camera: Part
    background: Part
    def __init__(self, scene: Scene = ...) -> None: ...
    def copy(self) -> Scene: ...
    @staticmethod
    def open(file: File{", *" + options}) -> Scene: ...
    @staticmethod
    def from_text(text: str, file: File = "scene.ray"{", *" + options}) -> Scene: ...
    def add(self, *nodes: Node | Sequence[Node]) -> Any: ...
    def add_text(self, statements: str) -> None: ...
    def object(self, name: str) -> Part: ...
    def light(self, name: str) -> Part: ...
    def material(self, name: str) -> Part: ...
    def choose(self{", *" + options}) -> None: ...
    def chosen(self, option: str{", *" + options}) -> str: ...
    def render(self, progress: OnProgress = None{", *" + options}) -> Render: ...
    def explain(self, x: int, y: int, sample: int = 0{", *" + options}) -> dict[str, Any]: ...
    def explain_text(self, x: int, y: int, sample: int = 0{", *" + options}) -> str: ...
    def lint(self{", *" + options}) -> list[Problem]: ...
    def save(self, file: File) -> list[Problem]: ...
    def _repr_png_(self) -> bytes: ...
'''


def stubs():
    text = HEAD + scene_class() + TAIL
    for kind in tr.kinds():
        if kind.category in ("camera", "background"):
            text += "\n" + function(kind)
    for category in ("shape", "light", "material", "texture"):
        text += f"\nclass {category}s:\n"
        text += "\n".join(function(kind, "    ") for kind in tr.kinds() if kind.category == category)
        if category == "material":
            text += "\n    @staticmethod\n    def library(name: str, **changes: Any) -> Node: ...\n"
        if category == "texture":
            text += "\n    @staticmethod\n    def scaled(texture: Node, by: float | Sequence[float]) -> Node: ...\n"
            text += "    @staticmethod\n    def picture(file: File) -> Node: ...\n"
    return text


if __name__ == "__main__":
    with open(sys.argv[1], "w") as out:
        out.write(stubs())
