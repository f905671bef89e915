"""Trace, the ray tracer you can see inside, as a module of Python.

    import traceray as tr

    scene = tr.Scene()
    scene.add(tr.shapes.sphere(material=tr.materials.phong(diffuse=(1, 0, 0))))
    picture = scene.render(width=320)
    picture.write("ball.png")
    picture.image.shape        # (240, 320, 3): linear light, float32

`shapes`, `lights`, `materials` and `textures` have a function for each kind of thing, which makes a node of it;
`camera`, `background` and `settings` make the others. help(tr.shapes.torus) shows its fields.
"""

import difflib
import inspect
import types

from . import _core
from ._core import (Difference, Error, FieldInfo, Grade, Grades, Interrupted, Kind, Node, Part, Problem, Render, Scene,
                    __version__, diff, grade, kinds, options, read, write)

__all__ = ["Difference", "Error", "FieldInfo", "Grade", "Grades", "Interrupted", "Kind", "Node", "Part", "Problem",
           "Render", "Scene", "background", "camera", "diff", "grade", "kinds", "lights", "materials", "open", "options", "read", "settings",
           "shapes", "textures", "write"]

open = Scene.open

#: What every shape takes beside its own fields.
SHAPE_FIELDS = {
    "name": "by which it is found: scene.object(name)",
    "material": "a node of materials, or the name of one of the library, as \"gold\"",
    "scale": "a number or (x, y, z), before all else",
    "rotate": "(x, y, z, degrees): an axis and an angle, then",
    "translate": "(x, y, z), then",
    "transform": "four rows of four numbers, at last",
}
MATERIAL_FIELDS = {"name": "by which it is found: scene.material(name)",
                   "library": "the name of a material to start from, as \"gold\""}
_MORE = {"shape": SHAPE_FIELDS, "material": MATERIAL_FIELDS}


def _python_name(name):
    """A field whose name Python keeps for itself has _ behind it."""
    import keyword

    return name + "_" if keyword.iskeyword(name) else name


def _describe(field):
    parts = [field.help] if field.help else []
    if field.unit:
        parts.append(field.unit)
    if field.choices:
        parts.append("one of " + ", ".join(field.choices))
    elif abs(field.least) != float("inf") and field.least < field.most:
        most = "" if field.most == float("inf") else f" to {field.most:g}"
        parts.append(f"from {field.least:g}{most}")
    return "; ".join(parts)


def parameters(kind):
    """The fields of a kind as (name, description, default), for signatures and stubs."""
    own = [(_python_name(f.name), _describe(f), f.usual) for f in kind.fields]
    known = {name for name, _, _ in own}
    more = [(name, text, None) for name, text in _MORE.get(kind.category, {}).items() if name not in known]
    return own + more


def takes_objects(kind):
    """Solids of solids take the objects that they are made of as arguments."""
    return any(field.type == "objects" for field in kind.fields)


def docstring(kind):
    lines = [kind.help[:1].upper() + kind.help[1:] + ".", ""]
    lines += [f"    {name}: {text}" for name, text, _ in parameters(kind)]
    return "\n".join(lines)


def _is_read(kind, name):
    """Does the reader know the field? It takes a few names that no list has, as `colour`."""
    node = Node(kind.keyword, **{name: 1})
    if kind.category == "texture":
        node = Node("lambert", diffuse=node)
    if kind.category in ("texture", "material"):
        node = Node("sphere", material=node)
    try:
        Scene().add(node)
    except Error as error:
        return not any(f'no field "{name}"' in problem.what or problem.what == f'"{name}" is not known'
                       for problem in error.problems)
    return True


def _check_fields(kind, given):
    """Raises TypeError for a field that the kind does not have, before the node is added to anything."""
    known = [name for name, _, _ in parameters(kind)]
    for name in given:
        if name in known or _python_name(name) in known or _is_read(kind, name.removesuffix("_")):
            continue
        text = f'{kind.keyword} has no field "{name}"'
        if kind.keyword == "sphere" and name == "radius":
            text += "; scale=2 makes it twice as large"
        else:
            text += "".join(f'; did you mean "{near}"?' for near in difflib.get_close_matches(name, known, 1))
        raise TypeError(text + "; it has " + ", ".join(known))


def _builder(kind):
    solid = takes_objects(kind)

    def build(*objects, **fields):
        if objects and not solid:
            raise TypeError(f"{kind.keyword} takes fields by their names, as in {kind.keyword}(name=...)")
        _check_fields(kind, fields)
        if objects:
            fields["objects"] = [*objects]
        return Node(kind.keyword, **fields)

    build.__name__ = build.__qualname__ = kind.keyword
    build.__doc__ = docstring(kind)
    signature = [inspect.Parameter("objects", inspect.Parameter.VAR_POSITIONAL)] if solid else []
    signature += [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=usual)
                  for name, _, usual in parameters(kind) if not (solid and name == "objects")]
    build.__signature__ = inspect.Signature(signature)
    return build


def _namespace(category, doc):
    space = types.ModuleType(f"{__name__}.{category}s", doc)
    for kind in kinds():
        if kind.category == category:
            setattr(space, kind.keyword, _builder(kind))
    space.__all__ = [kind.keyword for kind in kinds() if kind.category == category]
    return space


shapes = _namespace("shape", "A function for each shape.")
lights = _namespace("light", "A function for each light.")
materials = _namespace("material", "A function for each shading model, and `library`.")
textures = _namespace("texture", "A function for each texture, `picture` and `scaled`.")
for _kind in kinds():
    if _kind.category == "camera":
        camera = _builder(_kind)
    elif _kind.category == "background":
        background = _builder(_kind)


def _library(name, **changes):
    """A material of the library, as "gold" or "water" (docs/library.md, docs/indices.md), with changes of its fields."""
    return Node("material", library=name, **changes)


def _scaled(texture, by):
    """The texture times a number or a colour: the height of `bump`, for one."""
    return Node("texture", texture, by)


def _picture(file):
    """A picture file on a surface."""
    return Node("map", file)


materials.library = _library
textures.scaled = _scaled
textures.picture = _picture


def settings(**options):
    """Options as the scene itself says them; those of Scene.choose and Scene.render override them."""
    return Node("settings", **{name.replace("_", "-"): value for name, value in options.items()})
