"""The Python module: what it adds to the library, whose own tests are in C++."""

import ast
import gc
import inspect
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import traceray as tr

CHECKOUT = pathlib.Path(os.environ["TRACE_CHECKOUT"])
SMALL = dict(width=24, quality="none", integrator="whitted", spp=1)
ENDLESS = dict(width=64, quality="none", integrator="path", spp=65536)


def ball(**options):
    scene = tr.Scene()
    scene.add(tr.shapes.sphere(name="ball", material=tr.materials.phong(diffuse=(0.8, 0.4, 0.2))),
              tr.lights.directional_light(direction=(0, 0, -1), color=(1, 1, 1), name="key"),
              tr.camera(position=(0, 0, 4), look_at=(0, 0, 0), fov=40, aspectratio=1))
    scene.choose(**(options or SMALL))
    return scene


def test_pictures_are_arrays_of_linear_light():
    render = ball().render()
    image = render.image
    assert image.shape == (24, 24, 3) and image.dtype == np.float32
    assert image[12, 12] == pytest.approx([0.8, 0.4, 0.2], abs=0.02)
    assert not image[0, 0].any()
    assert np.asarray(render).shape == image.shape
    assert render.finished and render.end == "finished" and "24 x 24" in repr(render)
    del render
    gc.collect()
    assert image[12, 12, 0] > 0.7, "an array keeps the render that it is a view of"
    with pytest.raises(ValueError):
        image[0, 0] = 1


def test_fields_are_attributes():
    scene = ball()
    part = scene.object("ball")
    assert part.keyword == "sphere" and part.category == "object"
    part.material.diffuse = (0.1, 0.2, 0.3)
    assert part.material.diffuse == (0.1, 0.2, 0.3)
    scene.light("key").color = 2 * np.ones(3)
    scene.background.color = [0.25, 0.5, 1]
    scene.camera.set(position=(0, 0, 8), look_at=(0, 0, 0))
    image = scene.render().image
    assert image[12, 12, 2] == pytest.approx(0.6, abs=0.02)
    assert image[0, 0] == pytest.approx([0.25, 0.5, 1])
    part.move(translate=(1, 0, 0))
    assert part.transform[0, 3] == 1
    part.transform = np.eye(4)
    assert part.transform[0, 3] == 0
    part.name = "other"
    assert scene.object("other").name == "other"
    part.material = "gold"
    assert part.material.keyword == "conductor"
    with pytest.raises(AttributeError, match="no field"):
        part.material.no_such_field
    with pytest.raises(tr.Error):
        part.material.no_such_field = 1


def test_no_field_hides_behind_an_attribute():
    own = {name for name in dir(tr.Part) if not name.startswith("__")}
    fields = {field.name for kind in tr.kinds() if kind.category != "texture" for field in kind.fields}
    assert own & fields <= {"name", "material"}


def test_every_kind_has_a_function_with_its_fields():
    for kind in tr.kinds():
        if kind.category in ("camera", "background"):
            build = getattr(tr, kind.category)
        else:
            build = getattr(getattr(tr, kind.category + "s"), kind.keyword)
        names = set(inspect.signature(build).parameters)
        for field in kind.fields:
            assert field.name in names or field.name + "_" in names
            assert field.help in build.__doc__
    assert {"width", "spp", "integrator"} <= {option.name for option in tr.options()}
    assert "noise_target: " in tr.Scene.render.__doc__


def test_stubs_say_what_the_functions_take():
    tree = ast.parse((pathlib.Path(tr.__file__).parent / "__init__.pyi").read_text())
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    for kind in tr.kinds():
        if kind.category in ("camera", "background"):
            continue
        functions = {f.name: f for f in classes[kind.category + "s"].body if isinstance(f, ast.FunctionDef)}
        stub = {a.arg for a in functions[kind.keyword].args.kwonlyargs}
        real = inspect.signature(getattr(getattr(tr, kind.category + "s"), kind.keyword)).parameters
        assert stub == {name for name, p in real.items() if p.kind is p.KEYWORD_ONLY}
        assert ast.get_docstring(functions[kind.keyword])
    methods = {f.name for f in classes["Scene"].body if isinstance(f, ast.FunctionDef)}
    missing = {name for name in vars(tr.Scene) if not name.startswith("__")} - methods
    fields = {a.target.id for a in classes["Scene"].body if isinstance(a, ast.AnnAssign)}
    assert missing <= fields
    render = next(f for f in classes["Scene"].body if isinstance(f, ast.FunctionDef) and f.name == "render")
    assert {o.name.replace("-", "_") for o in tr.options()} <= {a.arg for a in render.args.kwonlyargs}


def test_solids_and_textures_nest():
    scene = tr.Scene()
    scene.add(tr.shapes.difference(tr.shapes.box(), tr.shapes.sphere(scale=0.6), name="die", material="red granite"),
              tr.shapes.plane(translate=(0, -0.5, 0),
                              material=tr.materials.lambert(diffuse=tr.textures.checker(a=(1, 1, 1), b=(0, 0, 0)),
                                                            bump=tr.textures.scaled(tr.textures.noise(), 0.01))))
    assert len(scene.objects) == 2
    assert isinstance(scene.objects[1].material.diffuse, tr.Node)
    assert "checker" in repr(scene.objects[1].node())
    assert scene.render(**SMALL).image.max() > 0


def test_meshes_come_as_arrays():
    points = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], dtype=np.float32)
    scene = tr.Scene()
    scene.add(tr.shapes.polymesh(points=points, faces=np.array([[0, 1, 2]])),
              tr.camera(position=(0, 0, 3), look_at=(0, 0, 0)))
    assert scene.render(**SMALL, passes="depth").passes["depth"].min() == pytest.approx(3, abs=1e-3)


def test_errors_tell_the_place():
    with pytest.raises(tr.Error) as caught:
        tr.Scene.from_text("SBT-raytracer 1.0\nsphere { radus = }\n", "room.ray")
    assert caught.value.kind == "scene"
    assert (caught.value.problems[0].file, caught.value.problems[0].line) == ("room.ray", 2)
    with pytest.raises(tr.Error, match="did you mean \"width\""):
        ball().render(widht=3)
    with pytest.raises(tr.Error, match="no such"):
        tr.open("no such scene.ray")
    with pytest.raises(TypeError):
        tr.shapes.sphere(1)
    with pytest.raises(TypeError):
        tr.shapes.sphere(name=None)


def test_progress_stops_and_its_exceptions_pass():
    calls = []
    render = ball(**ENDLESS).render(lambda done, seconds: (calls.append(done), done == 0)[1])
    assert render.end == "cancelled" and calls[0] == 0 and calls[-1] > 0
    assert render.image.max() > 0
    with pytest.raises(ZeroDivisionError):
        ball(**ENDLESS).render(lambda done, seconds: 1 / 0)


def test_other_threads_run_while_a_picture_is_rendered():
    counted = []
    done = threading.Event()

    def count():
        while not done.wait(0.001):
            counted.append(1)

    thread = threading.Thread(target=count)
    thread.start()
    ball(**ENDLESS).render(lambda done, seconds: done == 0)
    done.set()
    thread.join()
    assert len(counted) > 5


def test_interrupt_keeps_what_was_traced():
    def press():
        time.sleep(0.4)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        ball(**ENDLESS).render()
    thread.join()
    assert isinstance(caught.value, tr.Interrupted)
    assert caught.value.render.end == "cancelled" and caught.value.render.image.max() > 0


def test_explain_is_a_dict():
    why = ball().explain(12, 12)
    assert why["schema"] == "trace-explain" and why["agrees"]
    assert why["pixel"] == pytest.approx([0.8, 0.4, 0.2], abs=0.02)
    assert "hits \"ball\"" in ball().render().explain_text(12, 12)


def test_diff_takes_arrays_renders_and_files(tmp_path):
    render = ball().render()
    assert tr.diff(render, render).identical
    other = render.image.copy()
    other[3, 5] = 1
    difference = tr.diff(render, other)
    assert "rmse" in repr(difference) and dict(difference)["max"] == 1
    assert difference["max"] == 1 and difference.worst == (5, 3) and difference.unit == "values"
    assert difference.heat.shape == other.shape
    assert render.write(tmp_path / "a.png") == str(tmp_path / "a.png")
    levels = (tr.read(tmp_path / "a.png") * 255).round().astype(np.uint8)
    assert tr.diff(tmp_path / "a.png", levels).unit == "levels"
    assert tr.diff(str(tmp_path / "a.png"), levels)["max"] == 0
    tr.write(tmp_path / "b.exr", render.image)
    assert tr.diff(tmp_path / "b.exr", render).metrics["max"] < 1e-3


def test_an_unknown_field_fails_at_once_and_names_the_fields_there_are():
    with pytest.raises(TypeError, match='sphere has no field "radius"; scale=2 makes it .*; it has .*scale'):
        tr.shapes.sphere(radius=2)
    with pytest.raises(TypeError, match='did you mean "roughness"'):
        tr.materials.conductor(rougness=0.2)
    with pytest.raises(TypeError, match="no field"):
        tr.materials.phong(roughness=0.2)
    with pytest.raises(TypeError, match="no field"):
        tr.textures.checker(c=1)
    with pytest.raises(TypeError, match="no field"):
        tr.lights.point_light(positon=(1, 2, 3))
    with pytest.raises(TypeError, match='did you mean "position"'):
        tr.camera(positions=(1, 2, 3))
    # What the reader takes besides its lists:
    tr.lights.point_light(position=(1, 2, 3), colour=(1, 1, 1), power=60)
    tr.shapes.torus(a=1, b=0.25)
    tr.camera(horizontal_fov=60)
    tr.background(color=(0, 0, 1))
    tr.shapes.polymesh(points=[(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces=[(0, 1, 2)], crease=30)


def test_warnings_go_when_a_field_is_mended(tmp_path):
    scene = tr.Scene()
    part = scene.add(tr.shapes.sphere(material=tr.materials.phong(diffuse=(0.5, 7, 0), index=-2)))
    assert ["diffuse" in warning.what for warning in scene.warnings] == [True, False]
    part.material.diffuse = (0.5, 0.7, 0)
    assert ["index" in warning.what for warning in scene.warnings] == [True]
    assert any("index" in warning.what for warning in scene.render(**SMALL).warnings)
    part.material.index = 1.5
    assert not scene.warnings and not any("index" in warning.what for warning in scene.render(**SMALL).warnings)
    part.material.diffuse = tr.textures.picture(tmp_path / "dots.png")
    assert any("dots.png" in warning.what for warning in scene.warnings)
    assert any("dots.png" in warning.what for warning in scene.render(**SMALL).warnings)
    tr.write(tmp_path / "dots.png", np.ones((2, 2, 3)))
    assert not scene.warnings and not any("dots.png" in warning.what for warning in scene.render(**SMALL).warnings)


def test_options_of_the_program_count_more_than_its_quality():
    scene = ball(spp=4, width=24)
    assert scene.chosen("spp", quality="draft") == "4"
    assert scene.chosen("noise_target", quality="draft") == "0"
    assert scene.chosen("spp", quality="draft", spp=2) == "2"


def test_a_picture_has_the_usual_shape_and_a_ball_is_round_in_any():
    scene = tr.Scene()
    scene.add(tr.shapes.sphere(material=tr.materials.phong(emissive=(1, 1, 1))),
              tr.background(color=(0, 0, 0)), tr.camera(position=(0, 0, 5), look_at=(0, 0, 0), fov=40))
    options = {**SMALL, "width": 64}
    assert scene.render(**options).image.shape == (48, 64, 3)
    for height in (32, 64, 96):
        lit = scene.render(**options, height=height).image[:, :, 0] > 0
        assert abs(int(lit[height // 2].sum()) - int(lit[:, 32].sum())) <= 2 < lit.sum()


def test_grade_compares_folders(tmp_path):
    grey, light = np.full((4, 4, 3), 0.5), np.full((4, 4, 3), 0.6)
    for folder, name, image in [("reference", "a.png", grey), ("reference", "b.png", grey),
                                ("reference", "c.png", grey), ("given", "a.png", grey), ("given", "b.png", light)]:
        (tmp_path / folder).mkdir(exist_ok=True)
        tr.write(tmp_path / folder / name, image)
    given, reference = tmp_path / "given", tmp_path / "reference"
    grades = tr.grade(given, reference)
    assert [grade.verdict for grade in grades] == ["missing", "beyond", "identical"]
    assert (grades.passed, len(grades), grades.stopped) == (1, 3, "")
    assert grades["b.png"].metrics["max"] == pytest.approx(25, abs=1)
    assert "1 of 3 within the limits" in repr(grades) and "a.png" in str(grades)
    with pytest.raises(KeyError):
        grades["d.png"]
    loose = tr.grade(given, reference, limits={"max": 30}, page=tmp_path / "page.html")
    assert loose.passed == 2 and "b.png" in (tmp_path / "page.html").read_text()
    with pytest.raises(tr.Error, match="rmse"):
        tr.grade(given, reference, limits=["rmsee=3"])
    with pytest.raises(ZeroDivisionError):
        tr.grade(given, reference, lambda done, seconds: 1 / 0)


def test_grade_renders_scenes(tmp_path):
    for folder in ("given", "reference"):
        (tmp_path / folder).mkdir()
    ball().save(tmp_path / "given/ball.ray")
    tr.open(tmp_path / "given/ball.ray").render(**SMALL).write(tmp_path / "reference/ball.png")
    grades = tr.grade(tmp_path / "given", tmp_path / "reference", render=True, **SMALL)
    assert [grade.verdict for grade in grades] == ["identical"]


def test_the_stub_has_every_public_name():
    tree = ast.parse((pathlib.Path(tr.__file__).parent / "__init__.pyi").read_text())
    named = {node.name for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(tr.__all__) <= named
    for name in ("Grade", "Grades", "Difference", "Render", "Part", "Node"):
        stub = next(node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == name)
        said = {member.name for member in stub.body if isinstance(member, ast.FunctionDef)}
        said |= {member.target.id for member in stub.body if isinstance(member, ast.AnnAssign)}
        assert {member for member in vars(getattr(tr, name)) if not member.startswith("_")} <= said


def test_lint_save_and_open(tmp_path):
    scene = ball()
    scene.add(tr.shapes.sphere(name="in the way", material=tr.materials.phong(diffuse=(1, 1, 1)), translate=(0, 0, 4)))
    assert any(finding.check for finding in scene.lint())
    scene.objects[1].remove()
    scene.save(tmp_path / "ball.ray")
    again = tr.open(tmp_path / "ball.ray", width=8)
    assert again.objects[0].material.diffuse == (0.8, 0.4, 0.2)
    assert again.render(spp=1, quality="none").width == 8
    assert again.copy().objects[0].keyword == "sphere"


def test_notebooks_show_renders():
    assert ball().render()._repr_png_().startswith(b"\x89PNG")


@pytest.mark.parametrize("name", ["snell.ipynb", "sweep.ipynb"])
def test_notebooks_run(name, tmp_path):
    notebook = json.loads((CHECKOUT / "examples/python" / name).read_text())
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    result = subprocess.run([sys.executable, "-c", "\n\n".join(cells)], cwd=tmp_path, capture_output=True, text=True,
                            env={**os.environ, "TRACE_SMALL": "1"}, timeout=600)
    assert result.returncode == 0, result.stderr
    assert result.stdout.strip()


def test_the_how_to_works_when_pasted(tmp_path, monkeypatch, capsys):
    page = (CHECKOUT / "docs/how-to/from-python.md").read_text()
    code = "\n".join(re.findall(r"^```python\n(.*?)^```$", page, re.M | re.S))
    code = re.sub(r"width=\d+", "width=24", code).replace("(80, 60)", "(12, 9)")  # small pictures, and their middle
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "from-python.md", "exec"), {})
    assert tr.read("gold.png").shape == (18, 72, 3) and (tmp_path / "sheet.png").stat().st_size
    assert "bit for bit" in capsys.readouterr().out
