// The Python module of Trace: the face of the library (include/traceray/traceray.h), said in Python. What can
// be written in Python is in traceray/__init__.py.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/operators.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "traceray/traceray.h"

namespace py = pybind11;
namespace tr = traceray;

namespace {

using Array = py::array_t<float, py::array::c_style | py::array::forcecast>;

// --- values
// --------------------------------------------------------------------------------------------------

tr::Value valueOf(const py::handle& object) {
  if (py::isinstance<tr::Node>(object)) return object.cast<tr::Node>();
  if (py::isinstance<tr::Part>(object)) return object.cast<tr::Part&>().node();
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::hasattr(object, "__fspath__")) return py::str(object.attr("__fspath__")()).cast<std::string>();
  if (py::hasattr(object, "tolist")) return valueOf(object.attr("tolist")());  // numpy's arrays and numbers
  if (py::isinstance<py::int_>(object) || py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::iterable>(object) && !py::isinstance<py::dict>(object)) {
    tr::Value::List list;
    for (const py::handle one : object) list.push_back(valueOf(one));
    return list;
  }
  throw py::type_error("expected a number, a text, True or False, a list, or a node, found " +
                       py::repr(object).cast<std::string>());
}

/// Lists of numbers become tuples: vectors and colours.
py::object objectOf(const tr::Value& value) {
  if (value.isBoolean()) return py::bool_(value.boolean());
  if (value.isNumber()) {
    const double number = value.number();
    const auto whole = static_cast<long long>(std::abs(number) < 1e15 ? number : 0);
    if (static_cast<double>(whole) == number) return py::int_(whole);
    return py::float_(number);
  }
  if (value.isText()) return py::str(value.text());
  if (value.isNode()) return py::cast(value.node());
  py::list list;
  bool numbers = true;
  for (const tr::Value& one : value.list()) {
    list.append(objectOf(one));
    numbers = numbers && one.isNumber();
  }
  return numbers ? py::object(py::tuple(list)) : list;
}

/// Keyword arguments: `from_` is the field "from", whose name Python keeps for itself.
tr::Fields fieldsOf(const py::kwargs& given) {
  tr::Fields fields;
  for (const auto& [key, value] : given) {
    std::string name = key.cast<std::string>();
    if (name.ends_with('_')) name.pop_back();
    fields.push_back({std::move(name), valueOf(value)});
  }
  return fields;
}

/// The same of options, in whose names `_` stands for `-`.
tr::Options optionsOf(const py::kwargs& given) {
  tr::Options options = fieldsOf(given);
  for (tr::Field& option : options)
    for (char& c : option.name)
      if (c == '_') c = '-';
  return options;
}

py::dict dictOf(const std::vector<std::pair<std::string, double>>& metrics) {
  py::dict dict;
  for (const auto& [name, value] : metrics) dict[py::str(name)] = value;
  return dict;
}

// --- pictures
// ------------------------------------------------------------------------------------------------

/// An array over the values of an image that `owner` keeps: (height, width, 3), float32, read-only.
py::array arrayOf(const tr::Image& image, const py::handle& owner) {
  py::array_t<float> array({image.height, image.width, 3}, image.values.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// One of its own.
py::array arrayOf(tr::Image image) {
  auto* kept = new tr::Image(std::move(image));
  const py::capsule owner(kept, [](void* at) { delete static_cast<tr::Image*>(at); });
  return py::array_t<float>({kept->height, kept->width, 3}, kept->values.data(), owner);
}

/// Bytes are levels of 255; numbers are values.
tr::Image imageOf(const py::handle& object) {
  if (py::isinstance<tr::Render>(object)) return object.cast<const tr::Render&>().image();
  const py::array given = py::array::ensure(object);
  if (!given || given.ndim() != 3 || given.shape(2) != 3)
    throw py::type_error(
        "expected an array of the shape (height, width, 3), a render, or the name of a file");
  const bool levels = given.dtype().kind() == 'u' && given.itemsize() == 1;
  const Array values = Array::ensure(given);
  tr::Image image{.width = static_cast<int>(given.shape(1)),
                  .height = static_cast<int>(given.shape(0)),
                  .levels = levels};
  image.values.assign(values.data(), values.data() + values.size());
  if (levels)
    for (float& value : image.values) value /= 255;
  return image;
}

bool namesFile(const py::handle& object) {
  return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}
std::string fileOf(const py::handle& object) { return valueOf(object).text(); }

tr::Image imageOrFile(const py::handle& object) {
  return namesFile(object) ? tr::Image::read(fileOf(object)) : imageOf(object);
}

// --- rendering
// -----------------------------------------------------------------------------------------------

/// traceray.Interrupted, a KeyboardInterrupt that keeps the picture so far.
py::handle interrupted;

/// What Python did while Trace worked.
struct Heard {
  std::optional<py::error_already_set> thrown;
  bool interrupted = false;  ///< by Ctrl-C
};

/// Calls `progress` of Python, and looks for Ctrl-C. Both arguments outlive it.
tr::OnProgress heardBy(const std::optional<py::function>& progress, Heard& heard) {
  return [&](const tr::Progress& now) {
    const py::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return !progress || !(*progress)(now.fraction, now.seconds).is(py::bool_(false));
    } catch (py::error_already_set& error) {
      heard.interrupted = error.matches(PyExc_KeyboardInterrupt);
      heard.thrown.emplace(error);
      return false;
    }
  };
}

/// The result of work(), while other threads of Python run; null if it failed, with the failure.
template <class Work>
auto withoutGil(Work&& work, std::exception_ptr& failure) {
  std::optional<decltype(work())> result;
  const py::gil_scoped_release released;
  try {
    result.emplace(work());
  } catch (...) {
    failure = std::current_exception();
  }
  return result;
}

tr::Render renderScene(const tr::Scene& scene, const std::optional<py::function>& progress,
                       const py::kwargs& given) {
  const tr::Options options = optionsOf(given);
  Heard heard;
  std::exception_ptr failure;
  const tr::OnProgress watch = heardBy(progress, heard);
  std::optional<tr::Render> render = withoutGil([&] { return scene.render(options, watch); }, failure);
  if (heard.interrupted && render) {
    const py::object error =
        interrupted("the render was interrupted; what was traced is the attribute `render`");
    error.attr("render") = py::cast(std::move(*render));
    PyErr_SetObject(interrupted.ptr(), error.ptr());
    throw py::error_already_set();
  }
  if (heard.thrown) throw *heard.thrown;
  if (failure) std::rethrow_exception(failure);
  return std::move(*render);
}

// --- grading
// ---------------------------------------------------------------------------------------------------

/// {"rmse": 6}, "rmse=6" or several such texts.
std::vector<std::string> limitsOf(const py::object& given) {
  if (given.is_none()) return {};
  if (py::isinstance<py::str>(given)) return {given.cast<std::string>()};
  std::vector<std::string> limits;
  if (py::isinstance<py::dict>(given)) {
    for (const auto& [name, value] : given.cast<py::dict>())
      limits.push_back(name.cast<std::string>() + "=" + py::str(value).cast<std::string>());
  } else {
    for (const py::handle one : given) limits.push_back(one.cast<std::string>());
  }
  return limits;
}

tr::Grades gradeFolders(const py::object& folder, const py::object& reference,
                        const std::optional<py::function>& progress, bool render, const py::object& limits,
                        double tolerance, const py::object& page, bool strict, double sceneLimit,
                        const py::kwargs& given) {
  const std::string pictures = fileOf(folder), references = fileOf(reference);
  const tr::GradeOptions options{.renderScenes = render,
                                 .options = optionsOf(given),
                                 .strict = strict,
                                 .tolerance = tolerance,
                                 .limits = limitsOf(limits),
                                 .page = page.is_none() ? std::string() : fileOf(page),
                                 .sceneLimit = sceneLimit};
  Heard heard;
  std::exception_ptr failure;
  const tr::OnProgress watch = heardBy(progress, heard);
  std::optional<tr::Grades> grades =
      withoutGil([&] { return tr::grade(pictures, references, options, watch); }, failure);
  if (heard.thrown) throw *heard.thrown;
  if (failure) std::rethrow_exception(failure);
  return std::move(*grades);
}

std::string textOf(const tr::Grade& grade) {
  std::ostringstream text;
  text << grade.verdict << "  " << grade.name;
  for (const auto& [name, value] : grade.metrics) text << "  " << name << " " << value;
  if (!grade.problem.empty()) text << "  " << grade.problem.substr(0, grade.problem.find('\n'));
  if (!grade.cause.empty()) text << "  " << grade.cause;
  return text.str();
}

std::string textOf(const tr::Grades& grades) {
  std::string text;
  for (const tr::Grade& grade : grades.pictures) text += textOf(grade) + "\n";
  for (const std::string& file : grades.extra) text += file + ": has no reference\n";
  if (!grades.stopped.empty()) text += grades.stopped + "\n";
  return text + std::to_string(grades.passed) + " of " + std::to_string(grades.pictures.size()) +
         " within the limits";
}

py::object fromJson(const std::string& json) { return py::module_::import("json").attr("loads")(json); }

py::bytes pngOf(const tr::Render& render) {
  std::string bytes;
  {
    const py::gil_scoped_release released;
    bytes = render.png();
  }
  return bytes;
}

/// "name: help; unit; from 0 to 1; 0.5 by default", a line for each.
std::string listOf(const std::vector<tr::FieldInfo>& fields, bool options) {
  std::string text;
  for (const tr::FieldInfo& field : fields) {
    std::string name = field.name;
    if (options)
      for (char& c : name)
        if (c == '-') c = '_';
    text += "    " + name + ": " + field.help + "\n";
  }
  return text;
}

// --- parts
// ---------------------------------------------------------------------------------------------------

py::array transformOf(const tr::Part& part) {
  const std::array<double, 16> numbers = part.transform();
  py::array_t<double> array({4, 4});
  std::copy(numbers.begin(), numbers.end(), array.mutable_data());
  return array;
}

void setTransform(tr::Part& part,
                  const py::array_t<double, py::array::c_style | py::array::forcecast>& rows) {
  if (rows.size() != 16) throw py::type_error("transform: expected an array of the shape (4, 4)");
  std::array<double, 16> numbers;
  std::copy(rows.data(), rows.data() + 16, numbers.begin());
  part.setTransform(numbers);
}

/// A field, unless it is an attribute of the class.
py::object attributeOf(const tr::Part& part, const std::string& name) {
  try {
    return objectOf(part.get(name));
  } catch (const tr::Error& error) {
    throw py::attribute_error(error.what());
  }
}

void setAttribute(const py::object& self, const py::str& name, const py::object& value) {
  if (py::hasattr(py::type::of(self), name)) {
    if (PyObject_GenericSetAttr(self.ptr(), name.ptr(), value.ptr()) != 0) throw py::error_already_set();
    return;
  }
  self.cast<tr::Part&>().set(name.cast<std::string>(), valueOf(value));
}

void addErrors(py::module_& module) {
  static py::handle error = py::exception<tr::Error>(module, "Error").release();
  error.attr("__doc__") =
      "What goes wrong: `kind` is file, usage, scene or limit; `problems` lists each with file, line and "
      "column.";
  interrupted = PyErr_NewExceptionWithDoc(
      "traceray.Interrupted",
      "A KeyboardInterrupt while a picture was rendered: `render` is what was traced.",
      PyExc_KeyboardInterrupt, nullptr);
  module.attr("Interrupted") = interrupted;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const tr::Error& caught) {
      constexpr const char* kKinds[] = {"file", "usage", "scene", "limit"};
      const py::object instance = error(caught.what());
      instance.attr("kind") = kKinds[static_cast<std::size_t>(caught.kind())];
      instance.attr("problems") = caught.problems();
      PyErr_SetObject(error.ptr(), instance.ptr());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of traceray.";
  module.attr("__version__") = tr::version();

  py::class_<tr::Problem>(module, "Problem", "An error, a warning, or a finding of lint.")
      .def_readonly("file", &tr::Problem::file)
      .def_readonly("line", &tr::Problem::line)
      .def_readonly("column", &tr::Problem::column)
      .def_readonly("is_error", &tr::Problem::isError)
      .def_readonly("what", &tr::Problem::what)
      .def_readonly("hint", &tr::Problem::hint)
      .def_readonly("check", &tr::Problem::check)
      .def("__str__", [](const tr::Problem& problem) { return problem.text; })
      .def("__repr__", [](const tr::Problem& problem) { return "<Problem: " + problem.what + ">"; });
  addErrors(module);

  py::class_<tr::FieldInfo>(module, "FieldInfo", "A field of a kind, or an option.")
      .def_readonly("name", &tr::FieldInfo::name)
      .def_readonly("type", &tr::FieldInfo::type)
      .def_readonly("unit", &tr::FieldInfo::unit)
      .def_readonly("least", &tr::FieldInfo::least)
      .def_readonly("most", &tr::FieldInfo::most)
      .def_readonly("help", &tr::FieldInfo::help)
      .def_readonly("choices", &tr::FieldInfo::choices)
      .def_property_readonly("usual", [](const tr::FieldInfo& field) { return objectOf(field.usual); });
  py::class_<tr::Kind>(module, "Kind", "A kind of shape, light, material or texture, with its fields.")
      .def_readonly("category", &tr::Kind::category)
      .def_readonly("keyword", &tr::Kind::keyword)
      .def_readonly("help", &tr::Kind::help)
      .def_readonly("fields", &tr::Kind::fields);
  module.def("kinds", &tr::kinds, "All kinds of things, with their fields.");
  module.def("options", &tr::options, "All options of a render.");

  py::class_<tr::Node>(module, "Node", "A thing to be added to a scene, by its keyword and fields.")
      .def(
          py::init([](const std::string& keyword, const py::args& arguments, const py::kwargs& fields) {
            tr::Node node(keyword, fieldsOf(fields));
            for (const py::handle argument : arguments) node.fields.push_back({"", valueOf(argument)});
            return node;
          }),
          "Node(\"sphere\", radius=2); arguments without names stand in brackets, as in texture(noise, 0.1).")
      .def_readonly("keyword", &tr::Node::keyword)
      .def_property_readonly("fields",
                             [](const tr::Node& node) {
                               py::dict fields;
                               for (const tr::Field& field : node.fields)
                                 if (!field.name.empty()) fields[py::str(field.name)] = objectOf(field.value);
                               return fields;
                             })
      .def(
          "replace",
          [](tr::Node node, const py::kwargs& fields) {
            for (const tr::Field& field : fieldsOf(fields)) node = node.with(field.name, field.value);
            return node;
          },
          "A copy with other values of some fields.")
      .def(py::self == py::self)
      .def("__repr__", &tr::Node::inLanguage);

  py::class_<tr::Part>(
      module, "Part",
      "An object, a light, a material, the camera or the background of a scene. Its fields are "
      "attributes, to be read and set.")
      .def_property_readonly("category", &tr::Part::category)
      .def_property_readonly("keyword", &tr::Part::keyword)
      .def_property("name", &tr::Part::name,
                    [](tr::Part& part, const std::string& name) { part.set("name", name); })
      .def_property(
          "material", &tr::Part::material,
          [](tr::Part& part, const py::object& material) { part.set("material", valueOf(material)); })
      .def_property("transform", &transformOf, &setTransform,
                    "From the object to the world, as an array of 4 x 4.")
      .def_property_readonly("fields",
                             [](const tr::Part& part) {
                               py::dict fields;
                               for (const std::string& name : part.fields())
                                 fields[py::str(name)] = objectOf(part.get(name));
                               return fields;
                             })
      .def(
          "set", [](tr::Part& part, const py::kwargs& fields) { part.set(fieldsOf(fields)); },
          "Sets several fields at once.")
      .def(
          "move", [](tr::Part& part, const py::kwargs& fields) { part.move(fieldsOf(fields)); },
          "Moves an object on, by scale, rotate=(x, y, z, degrees) and translate, in this order.")
      .def("node", &tr::Part::node, "Its keyword and all fields, to be added to another scene.")
      .def("remove", &tr::Part::remove, "Takes an object or a light out of the scene.")
      .def("__getattr__", &attributeOf)
      .def("__setattr__", &setAttribute)
      .def("__repr__", [](const tr::Part& part) {
        const std::string name = part.name();
        return "<" + part.category() + ": " + part.keyword() + (name.empty() ? "" : " \"" + name + "\"") +
               ">";
      });

  py::class_<tr::Render>(module, "Render",
                         "A picture that was rendered. numpy takes it as the array `image`.")
      .def_property_readonly("width", &tr::Render::width)
      .def_property_readonly("height", &tr::Render::height)
      .def_property_readonly("finished", &tr::Render::finished, "All samples of all pixels are there.")
      .def_property_readonly("end", &tr::Render::end)
      .def_property_readonly("seconds", &tr::Render::seconds)
      .def_property_readonly("rays", &tr::Render::rays)
      .def_property_readonly("warnings", &tr::Render::warnings)
      .def_property_readonly(
          "image", [](const py::object& self) { return arrayOf(self.cast<tr::Render&>().image(), self); },
          "Linear light: (height, width, 3), float32, row 0 at the top.")
      .def_property_readonly(
          "shown", [](const tr::Render& render) { return arrayOf(render.shown()); },
          "What a PNG file of it shows: exposure, tone and transfer curve of its options, 0 to 1.")
      .def_property_readonly(
          "passes",
          [](const py::object& self) {
            const auto& render = self.cast<tr::Render&>();
            py::dict passes;
            for (const std::string& name : render.passes())
              passes[py::str(name)] = arrayOf(render.pass(name), self);
            return passes;
          },
          "The passes that were asked for, as arrays: render(passes=\"depth,normal\").")
      .def("__array__",
           [](const py::object& self, const py::args& rest, const py::kwargs&) {
             py::object array = arrayOf(self.cast<tr::Render&>().image(), self);
             return rest.empty() || rest[0].is_none() ? array : py::object(array.attr("astype")(rest[0]));
           })
      .def(
          "write", [](tr::Render& render, const py::object& file) { return render.write(fileOf(file)); },
          py::arg("file"), "Writes the picture and its passes; returns the picture's name.")
      .def("png", &pngOf, "The bytes of a PNG file.")
      .def("_repr_png_", &pngOf)
      .def(
          "explain",
          [](const tr::Render& render, int x, int y, int sample) {
            return fromJson(render.explain(x, y, sample).json());
          },
          py::arg("x"), py::arg("y"), py::arg("sample") = 0,
          "Why the pixel has its colour, as `ray explain --format json` has it.")
      .def(
          "explain_text",
          [](const tr::Render& render, int x, int y, int sample) {
            return render.explain(x, y, sample).text();
          },
          py::arg("x"), py::arg("y"), py::arg("sample") = 0, "The same in words.")
      .def("__repr__", [](const tr::Render& render) {
        return "<Render of " + std::to_string(render.width()) + " x " + std::to_string(render.height()) +
               " pixels, " + render.end() + ">";
      });

  const std::string help = listOf(tr::options(), true);
  const std::string renderHelp =
      "Renders the scene. `progress` is called with the fraction done and the seconds gone; it stops the "
      "render by "
      "False. Ctrl-C raises Interrupted, whose `render` is what was traced.\n\nOptions:\n" +
      help;
  py::class_<tr::Scene>(module, "Scene", "What a render needs. Scene() has no objects.")
      .def(py::init<>())
      .def(py::init<const tr::Scene&>(), py::arg("scene"), "A copy.")
      .def("copy", [](const tr::Scene& scene) { return tr::Scene(scene); })
      .def("__copy__", [](const tr::Scene& scene) { return tr::Scene(scene); })
      .def("__repr__",
           [](tr::Scene& scene) {
             return "<Scene: " + std::to_string(scene.objects().size()) + " objects, " +
                    std::to_string(scene.lights().size()) + " lights>";
           })
      .def("__deepcopy__", [](const tr::Scene& scene, const py::dict&) { return tr::Scene(scene); })
      .def_static(
          "open",
          [](const py::object& file, const py::kwargs& options) {
            const std::string name = fileOf(file);
            const tr::Options given = optionsOf(options);
            const py::gil_scoped_release released;
            return tr::Scene::open(name, given);
          },
          py::arg("file"), "Reads a scene file of any format.")
      .def_static(
          "from_text",
          [](const std::string& text, const py::object& file, const py::kwargs& options) {
            const std::string name = fileOf(file);
            const tr::Options given = optionsOf(options);
            const py::gil_scoped_release released;
            return tr::Scene::fromText(text, name, given);
          },
          py::arg("text"), py::arg("file") = "scene.ray",
          "Reads the text of a scene file; `file` is its name.")
      .def_property_readonly("warnings", &tr::Scene::warnings)
      .def(
          "add",
          [](tr::Scene& scene, const py::args& nodes) {
            py::list parts;
            for (const py::handle node : nodes) {
              const tr::Value value = valueOf(node);
              if (value.isList())
                for (const tr::Value& one : value.list()) parts.append(scene.add(one.node()));
              else
                parts.append(scene.add(value.node()));
            }
            return parts.size() == 1 ? py::object(parts[0]) : parts;
          },
          "Adds nodes: shapes, lights, the camera, the background. Returns the part, or a list of several.")
      .def("add_text", &tr::Scene::addText, py::arg("statements"), "Adds statements of the scene language.")
      .def_property_readonly("objects", &tr::Scene::objects)
      .def_property_readonly("lights", &tr::Scene::lights)
      .def_property_readonly("materials", &tr::Scene::materials)
      .def_property_readonly("camera", &tr::Scene::camera)
      .def_property_readonly("background", &tr::Scene::background)
      .def("object", &tr::Scene::object, py::arg("name"))
      .def("light", &tr::Scene::light, py::arg("name"))
      .def("material", &tr::Scene::material, py::arg("name"))
      .def(
          "choose",
          [](tr::Scene& scene, const py::kwargs& options) {
            for (const tr::Field& option : optionsOf(options)) scene.choose(option.name, option.value);
          },
          "Options for all renders of this scene.")
      .def(
          "chosen",
          [](const tr::Scene& scene, const std::string& option, const py::kwargs& options) {
            std::string name = option;
            for (char& c : name)
              if (c == '_') c = '-';
            return scene.chosen(name, optionsOf(options));
          },
          py::arg("option"), "The value of an option as a render has it, as text.")
      .def("render", &renderScene, py::arg("progress") = py::none(), renderHelp.c_str())
      .def(
          "explain",
          [](const tr::Scene& scene, int x, int y, int sample, const py::kwargs& options) {
            const tr::Options given = optionsOf(options);
            std::string json;
            {
              const py::gil_scoped_release released;
              json = scene.explain(x, y, given, sample).json();
            }
            return fromJson(json);
          },
          py::arg("x"), py::arg("y"), py::arg("sample") = 0,
          "Renders one pixel; tells why it has its colour, as `ray explain --format json` does.")
      .def(
          "explain_text",
          [](const tr::Scene& scene, int x, int y, int sample, const py::kwargs& options) {
            const tr::Options given = optionsOf(options);
            const py::gil_scoped_release released;
            return scene.explain(x, y, given, sample).text();
          },
          py::arg("x"), py::arg("y"), py::arg("sample") = 0, "The same in words.")
      .def(
          "lint",
          [](const tr::Scene& scene, const py::kwargs& options) {
            const tr::Options given = optionsOf(options);
            const py::gil_scoped_release released;
            return scene.lint(given);
          },
          "What is likely a mistake.")
      .def(
          "save", [](const tr::Scene& scene, const py::object& file) { return scene.save(fileOf(file)); },
          py::arg("file"), "Writes the scene in the format of the name; returns warnings.")
      .def("_repr_png_", [](const tr::Scene& scene) {
        py::kwargs small;
        small["width"] = 320;
        small["quality"] = "draft";
        return pngOf(renderScene(scene, {}, small));
      });

  py::class_<tr::Difference>(module, "Difference", "How far two pictures are apart.")
      .def_readonly("same_size", &tr::Difference::sameSize)
      .def_readonly("identical", &tr::Difference::identical)
      .def_readonly("unit", &tr::Difference::unit)
      .def_property_readonly("metrics",
                             [](const tr::Difference& difference) { return dictOf(difference.metrics); })
      .def("__getitem__", &tr::Difference::metric)
      .def("keys",
           [](const tr::Difference& difference) {
             py::list names;
             for (const auto& metric : difference.metrics) names.append(metric.first);
             return names;
           })
      .def("__repr__",
           [](const tr::Difference& difference) {
             if (!difference.sameSize) return std::string("<Difference: the sizes differ>");
             if (difference.identical) return std::string("<Difference: identical>");
             std::string text = "<Difference in " + difference.unit + ":";
             for (const auto& [name, value] : difference.metrics) {
               std::ostringstream number;
               number << value;
               text += " " + name + " " + number.str();
             }
             return text + ">";
           })
      .def_property_readonly("worst",
                             [](const tr::Difference& difference) {
                               return py::make_tuple(difference.worstX, difference.worstY);
                             })
      .def_property_readonly("heat",
                             [](const tr::Difference& difference) { return arrayOf(difference.heat); });
  module.def(
      "diff",
      [](const py::object& reference, const py::object& test, double tolerance) {
        const tr::Image wanted = imageOrFile(reference), found = imageOrFile(test);
        const py::gil_scoped_release released;
        return tr::diff(wanted, found, tolerance);
      },
      py::arg("reference"), py::arg("test"), py::arg("tolerance") = 0,
      "Compares two pictures: arrays, renders or names of files. Arrays of bytes are levels, others linear "
      "values.");

  py::class_<tr::Grade>(module, "Grade",
                        "A reference picture, and how far the picture of its name is from it.")
      .def_readonly("name", &tr::Grade::name)
      .def_readonly("file", &tr::Grade::file)
      .def_readonly("verdict", &tr::Grade::verdict)
      .def_readonly("passed", &tr::Grade::passed)
      .def_readonly("problem", &tr::Grade::problem)
      .def_readonly("cause", &tr::Grade::cause)
      .def_readonly("unit", &tr::Grade::unit)
      .def_readonly("width", &tr::Grade::width)
      .def_readonly("height", &tr::Grade::height)
      .def_property_readonly("metrics", [](const tr::Grade& grade) { return dictOf(grade.metrics); })
      .def("__repr__", [](const tr::Grade& grade) { return "<Grade: " + textOf(grade) + ">"; });
  py::class_<tr::Grades>(module, "Grades", "All pictures of a folder, worst first; print() shows a table.")
      .def_readonly("pictures", &tr::Grades::pictures)
      .def_readonly("extra", &tr::Grades::extra)
      .def_readonly("passed", &tr::Grades::passed)
      .def_readonly("stopped", &tr::Grades::stopped)
      .def("__len__", [](const tr::Grades& grades) { return grades.pictures.size(); })
      .def("__getitem__",
           [](const tr::Grades& grades, const std::string& name) {
             for (const tr::Grade& grade : grades.pictures)
               if (grade.name == name) return grade;
             throw py::key_error(name);
           })
      .def(
          "__iter__",
          [](const tr::Grades& grades) {
            return py::make_iterator(grades.pictures.begin(), grades.pictures.end());
          },
          py::keep_alive<0, 1>())
      .def("__repr__", [](const tr::Grades& grades) { return textOf(grades); });
  module.def(
      "grade", &gradeFolders, py::arg("folder"), py::arg("reference"), py::arg("progress") = py::none(),
      py::kw_only(), py::arg("render") = false, py::arg("limits") = py::none(), py::arg("tolerance") = 0,
      py::arg("page") = py::none(), py::arg("strict") = false, py::arg("scene_limit") = 0,
      "Compares the pictures of a folder with reference pictures of the same names, as `ray grade` does. "
      "`render` renders the folder's scenes, with the options given. `limits` are such as {\"rmse\": 6}; "
      "without them pictures have to be equal. `page` names an HTML page to write. `scene_limit` is in "
      "seconds. When `progress` returns False, the rest is not reached.");
  module.def(
      "read", [](const py::object& file) { return arrayOf(tr::Image::read(fileOf(file))); }, py::arg("file"),
      "A picture file as an array of floats: (height, width, 3).");
  module.def(
      "write", [](const py::object& file, const py::object& image) { imageOf(image).write(fileOf(file)); },
      py::arg("file"), py::arg("image"), "Writes an array as a picture, in the format of the name.");
}
