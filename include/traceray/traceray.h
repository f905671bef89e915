// Trace as a library: open or build a scene, edit it, render it, look at the picture and ask why.
//
//   traceray::Scene scene = traceray::Scene::open("room.ray");
//   scene.render({{"width", 320}, {"spp", 16}}).write("room.png");
//
// This header is all that is public; docs/cpp.md lists it. A scene may be used by one thread at a time;
// different scenes may be used by different threads. Everything that fails throws traceray::Error, and
// nothing prints or exits.
//
// Versions: the library's SOVERSION is 0 while the version of Trace begins with 0. Programs then have to be
// compiled anew for each minor version, and by a compiler with the same standard library.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#if defined(__GNUC__)
#define TRACERAY_API __attribute__((visibility("default")))
#else
#define TRACERAY_API
#endif

namespace traceray {

/// "Trace 0.1.0, commit 2093372".
TRACERAY_API std::string version();

// --- messages
// ------------------------------------------------------------------------------------------------

/// An error, a warning, or a finding of lint. What was built by a program has the file "built", where the
/// n-th thing that was added is line n.
struct TRACERAY_API Problem {
  std::string file{};
  int line = 0, column = 0;  ///< from 1; 0: the file as a whole
  bool isError = false;
  std::string what{};   ///< what was expected and what was found
  std::string hint{};   ///< what to try; may be empty
  std::string check{};  ///< the name of the check of lint that found it; else empty
  std::string text{};   ///< `file:line:column: error: what`, the line with a caret below, and the hint
};

/// The one type of exception. what() holds the text of all its problems.
class TRACERAY_API Error : public std::exception {
 public:
  enum class Kind {
    file,   ///< a file cannot be read or written
    usage,  ///< a name, a value or a call that makes no sense
    scene,  ///< what a scene says is wrong
    limit,  ///< out of memory or time
  };
  Error(Kind kind, std::vector<Problem> problems);
  Error(Kind kind, const std::string& what, const std::string& hint = {});
  Error(const Error&);
  Error& operator=(const Error&);
  ~Error() override;

  const char* what() const noexcept override;
  Kind kind() const;
  const std::vector<Problem>& problems() const;

 private:
  Kind kind_;
  std::vector<Problem> problems_;
  std::string text_;
};

// --- values
// --------------------------------------------------------------------------------------------------

class Node;
struct SceneState;
struct PartState;
struct RenderState;

/// The value of a field or an option: true or false, a number, a text (also the name of a choice or a file),
/// a list (also a vector or a colour), or a node (a material, a texture, an object of a solid).
class TRACERAY_API Value {
 public:
  using List = std::vector<Value>;

  Value(bool value);
  template <class Number>
  requires(std::integral<Number> || std::floating_point<Number>) &&
      (!std::same_as<Number, bool>)Value(Number value) : Value(static_cast<double>(value), 0) {}
  Value(const char* value);
  Value(std::string value);
  Value(std::string_view value);
  Value(List value);
  Value(std::initializer_list<Value> value);
  Value(Node value);
  Value(const Value&);
  Value(Value&&) noexcept;
  Value& operator=(const Value&);
  Value& operator=(Value&&) noexcept;
  ~Value();

  bool isBoolean() const;
  bool isNumber() const;
  bool isText() const;
  bool isList() const;
  bool isNode() const;

  /// Each throws Error(usage) if the value is something else.
  bool boolean() const;
  double number() const;
  const std::string& text() const;
  const List& list() const;
  const Node& node() const;
  std::vector<double> numbers() const;  ///< of a list of numbers

  /// As a scene file has it: `2`, `(1, 0, 0)`, `checker { scale = (2, 2, 2); }`. Throws Error(usage) for a
  /// text with a quotation mark, which no scene file can hold, and a number that is not finite.
  std::string inLanguage() const;

  bool operator==(const Value&) const;

 private:
  Value(double value, int);

  std::variant<bool, double, std::string, List, std::shared_ptr<const Node>> value_;
};

struct TRACERAY_API Field {
  std::string name;
  Value value;
  bool operator==(const Field&) const = default;
};
/// Of one name the last counts.
using Fields = std::vector<Field>;

/// A thing to be added, by its keyword and fields: Node("sphere", {{"material", red}}). kinds() lists them
/// all.
class TRACERAY_API Node {
 public:
  explicit Node(std::string keyword, Fields fields = {});

  std::string keyword;
  /// A field without a name is an argument, as in texture(noise { }, 0.1).
  Fields fields;

  /// Null if the field is not given.
  const Value* find(std::string_view name) const;
  /// The node with this field, in place of an earlier one.
  Node with(std::string name, Value value) const;

  std::string inLanguage() const;
  bool operator==(const Node&) const = default;
};

// --- what there is
// -------------------------------------------------------------------------------------------

/// A field of a kind, or an option of a render.
struct TRACERAY_API FieldInfo {
  std::string name{};
  std::string
      type{};  ///< "number", "whole number", "switch", "text", "vector", "color", "choice", "list", ...
  std::string unit{};  ///< "" for pure numbers
  double least = 0, most = 0;
  std::string help{};                  ///< one sentence, no full stop
  std::vector<std::string> choices{};  ///< of type "choice"
  Value usual = false;                 ///< the default
};
/// A kind of thing: the same lists of fields make the reader of scene files, the studio and the reference
/// pages.
struct TRACERAY_API Kind {
  std::string category;  ///< "shape", "light", "material", "texture", "camera", "background"
  std::string keyword, help;
  std::vector<FieldInfo> fields;
};
TRACERAY_API std::vector<Kind> kinds();
/// The options of a render, those of the command line.
TRACERAY_API std::vector<FieldInfo> options();

// --- pictures
// ------------------------------------------------------------------------------------------------

/// Linear light, or the values of a pass: height rows of width pixels of 3 channels (red, green, blue), from
/// the top left. Pixel (x, y) begins at values[3 * (y * width + x)].
struct TRACERAY_API Image {
  int width = 0, height = 0;
  bool levels =
      false;  ///< it came from a file of 8 bits a channel: 1 is white, and the curve is that of the file
  std::vector<float> values{};

  std::span<const float, 3> pixel(int x, int y) const {
    return std::span<const float, 3>(values.data() + 3 * (static_cast<std::size_t>(y) * width + x), 3);
  }
  std::span<const float> row(int y) const {
    return std::span(values).subspan(3 * static_cast<std::size_t>(y) * width,
                                     3 * static_cast<std::size_t>(width));
  }

  static Image read(const std::string& file);
  /// In the format of the name: .png, .exr, .hdr, .jpg and more. 8-bit formats clamp to 0..1 and round.
  void write(const std::string& file) const;
};

/// How far two pictures are apart, by the metrics of `ray diff`: in levels (0 to 255) if both have levels,
/// else in linear values.
struct TRACERAY_API Difference {
  bool sameSize = false, identical = false;
  std::string unit;  ///< "levels" or "values"
  /// "max", "mean", "rmse", "psnr" ...: docs/compare.md.
  std::vector<std::pair<std::string, double>> metrics{};
  int worstX = 0, worstY = 0;  ///< the first pixel with the largest difference
  Image heat{};                ///< where they differ, for the eye; empty if the sizes differ
  /// Throws Error(usage) for a name that is no metric.
  double metric(std::string_view name) const;
};
/// What differs by `tolerance` or less does not count as beyond.
TRACERAY_API Difference diff(const Image& reference, const Image& test, double tolerance = 0);
TRACERAY_API Difference diff(const std::string& reference, const std::string& test, double tolerance = 0);

// --- rendering
// -----------------------------------------------------------------------------------------------

/// Options of a render by their names, without dashes before them: {{"width", 640}, {"integrator", "path"}}.
/// They override those of the scene. Options that a program gives, here or by choose(), also override what
/// the option `quality` stands for. docs/options.md is the table.
using Options = Fields;

struct Progress {
  double fraction = 0;  ///< 0 to 1
  double seconds = 0;   ///< since the render began
};
/// Called when a render begins and then some times a second, by the thread that called render(). False stops
/// the render, which keeps what was traced. An exception stops it too, and leaves render().
using OnProgress = std::function<bool(const Progress&)>;

/// How `grade` compares a folder of pictures, or of scenes, with a folder of reference pictures.
struct TRACERAY_API GradeOptions {
  bool renderScenes = false;  ///< render the folder's scenes instead of reading its pictures
  Options options{};          ///< for these renders
  bool strict = false;        ///< warnings about a scene are errors
  double tolerance = 0;       ///< differences up to this do not count as beyond
  /// "rmse=6": pictures are equal enough while all hold; without limits, while nothing is beyond.
  std::vector<std::string> limits{};
  std::string page{};     ///< an HTML page to write, with all pictures; "" for none
  double sceneLimit = 0;  ///< seconds that one scene may take; 0 for no limit
};
/// A reference picture, and how far the picture of its name is from it.
struct TRACERAY_API Grade {
  std::string name{};  ///< of the reference, seen from its folder
  std::string file{};  ///< what was compared with it; "" if it is missing
  /// "identical", "within", "beyond", "sizes differ", "not reached", "unreadable" or "missing".
  std::string verdict{};
  bool passed = false;    ///< identical or within
  std::string problem{};  ///< why it could not be compared
  std::string cause{};    ///< one change of the whole picture that explains a failure, or ""
  std::string unit{};     ///< "levels" or "values"
  int width = 0, height = 0;
  std::vector<std::pair<std::string, double>> metrics{};  ///< empty if it could not be compared
};
struct TRACERAY_API Grades {
  std::vector<Grade> pictures{};     ///< worst first
  std::vector<std::string> extra{};  ///< files of the folder that have no reference
  std::size_t passed = 0;
  std::string stopped{};  ///< why some pictures were not reached; "" if all were
};
/// What `ray grade` does. Pairs are files of one name, whatever their suffixes. When `progress` returns
/// false, the pictures that are left are not reached. Throws Error where a folder cannot be read, or holds no
/// reference picture.
TRACERAY_API Grades grade(const std::string& folder, const std::string& reference,
                          const GradeOptions& options = {}, const OnProgress& progress = {});

/// Why a pixel has its colour: the tree of its rays.
class TRACERAY_API Explanation {
 public:
  const std::string& text() const { return text_; }  ///< as `ray explain` prints it
  const std::string& json() const { return json_; }  ///< docs/explain.md has the schema
  std::array<double, 3> pixel() const { return pixel_; }
  /// The rays recorded sum to the picture's pixel, bit for bit. False would be a fault of Trace.
  bool agrees() const { return agrees_; }

 private:
  friend class Render;
  std::string text_, json_;
  std::array<double, 3> pixel_{};
  bool agrees_ = false;
};

/// A picture that was rendered, with all it takes to explain it.
class TRACERAY_API Render {
 public:
  Render(Render&&) noexcept;
  Render& operator=(Render&&) noexcept;
  ~Render();

  int width() const;
  int height() const;
  /// All samples of all pixels are there.
  bool finished() const;
  /// "finished", "cancelled", "time limit", "out of memory", or "failed: " and the reason.
  std::string end() const;
  double seconds() const;                 ///< of tracing, on the clock
  std::uint64_t rays() const;             ///< that were traced
  std::vector<Problem> warnings() const;  ///< those of the scene, then those of the render

  /// Linear light, without tone and transfer curve; without noise, if the option `denoise` was on.
  const Image& image() const;
  /// What a PNG file of it shows: exposure, tone and transfer curve of its options, 0 to 1.
  Image shown() const;
  /// The passes that were asked for: render({{"passes", "depth,normal"}}).
  std::vector<std::string> passes() const;
  /// Its values; of one number all three channels are the same. Throws Error(usage) for one that was not
  /// asked for.
  const Image& pass(const std::string& name) const;

  /// Writes the picture, as shown() or as linear light by the format of the name, and its passes beside it. A
  /// part of a picture never replaces a whole one, but goes beside it. Returns the name of the file.
  std::string write(const std::string& file);
  /// The bytes of a PNG file of shown().
  std::string png() const;

  /// The rays of one sample of the pixel, (0, 0) at the top left. Throws Error(usage) for a pixel outside of
  /// the picture, and for pictures by chains (integrator mlt), whose pixels have no samples of their own.
  Explanation explain(int x, int y, int sample = 0) const;

 private:
  friend class Scene;
  explicit Render(std::unique_ptr<RenderState> state);
  std::unique_ptr<RenderState> state_;
};

// --- scenes
// --------------------------------------------------------------------------------------------------

/// A thing of a scene: an object, a light, a material, the camera or the background. It refers to the scene
/// and holds as long as that thing is there; afterwards its functions throw Error(usage).
class TRACERAY_API Part {
 public:
  std::string category() const;  ///< "object", "light", "material", "camera", "background"
  std::string keyword() const;   ///< "sphere", "point_light", "phong" ...
  std::string name() const;      ///< may be empty
  /// The names of its fields.
  std::vector<std::string> fields() const;
  /// Throws Error(usage) for a field that it does not have.
  Value get(std::string_view field) const;
  /// Its keyword, and all fields. Numbers that are infinite stand for no limit and are left out.
  Node node() const;

  /// Several fields at once count together, as a new camera's position and look_at. What is wrong throws
  /// Error(scene), and the part stays as it was. An object takes `name`, `material`, `lit_by` and
  /// `not_lit_by` beside the fields of its shape; a material may change its `model`.
  void set(const std::string& field, Value value);
  void set(const Fields& fields);

  /// The material of an object. Copies of a material are independent, unless a file gave several objects one.
  Part material() const;
  /// From the object to the world: 4 rows of 4 numbers, the last (0, 0, 0, 1).
  std::array<double, 16> transform() const;
  void setTransform(const std::array<double, 16>& worldFromObject);
  /// Moves an object on: scale, then rotate (axis and degrees), then translate, or a transform of four rows:
  /// move({{"translate", {0, 1, 0}}}).
  void move(const Fields& fields);
  /// Takes an object or a light out of the scene.
  void remove();

 private:
  friend class Scene;
  explicit Part(std::shared_ptr<PartState> state);
  std::shared_ptr<PartState> state_;
};

/// What a render needs. Copies are independent.
class TRACERAY_API Scene {
 public:
  /// Without objects. What is left out at the end is completed as in a file that begins with `Trace 1`
  /// (docs/trace-1.md): a camera that shows all objects, a sky and a sun, plain materials.
  Scene();
  /// Any format of docs/formats.md. `options` choose what reading depends on, such as {{"time", 2}}, and hold
  /// for all that follows. Throws Error.
  static Scene open(const std::string& file, const Options& options = {});
  /// The same of text; `file` gives it a name, and a folder for the files that it names.
  static Scene fromText(std::string_view text, const std::string& file = "scene.ray",
                        const Options& options = {});
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// About the scene as it is: a warning of a field goes when the field is set anew.
  std::vector<Problem> warnings() const;

  /// Adds a shape, a solid of solids (its field "objects" is a list of nodes), a light, the camera, the
  /// background or settings. Shapes take `scale`, `rotate` (axis and degrees) and `translate`, in this order,
  /// or `transform` (four rows) where they have no field of that name; `name`, and `material`: a node of a
  /// shading model, or of "material" with fields such as `library`. Angles are in degrees. Throws
  /// Error(scene); the scene then stays as it was.
  Part add(const Node& node);
  /// Adds statements of the scene language (docs/ray-format.md, docs/language.md), without a header.
  void addText(std::string_view statements);

  std::vector<Part> objects();
  std::vector<Part> lights();
  std::vector<Part> materials();
  Part camera();
  Part background();
  /// By their names. Throw Error(usage) with a "did you mean".
  Part object(std::string_view name);
  Part light(std::string_view name);
  Part material(std::string_view name);

  /// An option for all renders of this scene. Throws Error(usage).
  void choose(const std::string& option, const Value& value);
  /// The value of an option, as a render with `options` has it.
  std::string chosen(const std::string& option, const Options& options = {}) const;

  /// Blocks until the picture is there.
  Render render(const Options& options = {}, const OnProgress& progress = {}) const;
  /// Renders the one pixel, and tells why it has its colour.
  Explanation explain(int x, int y, const Options& options = {}, int sample = 0) const;
  /// What is likely a mistake (docs/lint.md).
  std::vector<Problem> lint(const Options& options = {}) const;

  /// Writes the scene in the format of the name. A .ray file that was opened keeps its text as far as
  /// possible. Returns warnings of what the format cannot hold. Throws Error(usage) rather than write over a
  /// file that the scene was read from, if that would lose something.
  std::vector<Problem> save(const std::string& file) const;

 private:
  explicit Scene(std::shared_ptr<SceneState> state);
  Part part(int category, std::uint64_t id);
  std::shared_ptr<SceneState> state_;
};

}  // namespace traceray
