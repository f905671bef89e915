// The interpreter of POV-Ray's scene language: it runs the directives while it reads statements. Each trade
// has its file: directives, expressions, objects, shapes, textures, and the camera with its lights.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/pov/pov_formula.h"
#include "formats/pov/pov_nodes.h"
#include "formats/pov/pov_paint.h"
#include "formats/pov/pov_query.h"
#include "formats/pov/pov_tokens.h"
#include "formats/pov/pov_values.h"
#include "formats/scene_time.h"
#include "formats/warnings.h"
#include "scene/input_files.h"

namespace trace::pov {

/// The file as a whole, once it is read.
struct World {
  std::vector<Ref<Node>> objects;
  std::optional<CameraNode> camera;
  std::vector<FogNode> fogs;
  std::optional<SkyNode> sky;
  std::optional<Color> background;
  Color ambientLight{1};
  Real gamma = 0;       ///< assumed_gamma; 0: not given
  Real version = 3.62;  ///< for a file that does not say, by the manual of POV-Ray 3.7
  int depth = 5;
  bool radiosity = false, photons = false;
  Ref<TextureNode> defaultTexture;
};

class Reader {
 public:
  Reader(const std::string& file, std::string_view text, InputFiles& inputs, SceneTime& time,
         Messages& messages);

  /// The whole file. Throws Error.
  World read();

  WarningsByKind& warnings() { return warnings_; }
  /// Whether the file asks which picture of an animation it is.
  bool asksFrame() const { return asksFrame_; }
  /// It is the first of an animation of one picture, and not, as POV-Ray has it by default, of none.
  void setAnimated() { frame_ = 1; }

 private:
  // --- tokens and directives (pov_directives.cpp) ---
  struct Frame {
    const Source* source;
    std::size_t at, end;
    std::size_t blocks, scopes;  ///< how many there were before
    bool macro;
  };
  struct Block {
    enum class Kind { condition, loop, count, choice };
    Kind kind;
    std::size_t start = 0;  ///< token after the directive
    Real chosen = 0;        ///< number of a #switch
    bool taken = false;
    Slot counter{};
    Real last = 0, step = 1;
    Token directive{};
  };
  using Scope = std::unordered_map<std::string, Slot>;

  const Token& peek();
  Token next();
  void fetch();
  void directive(const Token& at);
  void branch(const Token& at);
  void elseBranch(const Token& at);
  void skipBlock(bool stopsAtElse, bool stopsAtCase, const Token& from);
  void endBlock(const Token& at);
  void breakOut(const Token& at);
  void loop(const Token& at);
  void countLoop(const Token& at);
  void choose(const Token& at);
  bool seekCase(Block& block, const Token& from);
  void declare(bool local);
  void defineMacro(const Token& at);
  void callMacro(const Ref<Macro>& macro, const Token& at);
  void include(const Token& at);
  void setDefault();
  void say(const Token& at, const std::string& text);
  Token raw();
  const Token& rawPeek() const;
  void skipSemicolon();
  Numbers condition();
  template <class Body>
  auto untilDirective(Body&& body);
  void spend(const Token& at);
  /// Omissions go to the list as long as it lives.
  struct LeftTo {
    Reader& reader;
    Omissions* before;
    LeftTo(Reader& r, Omissions& to) : reader(r), before(r.left_) { r.left_ = &to; }
    ~LeftTo() { reader.left_ = before; }
    LeftTo(const LeftTo&) = delete;
    LeftTo& operator=(const LeftTo&) = delete;
  };

  Slot* find(std::string_view name);
  Slot elementSlot(Slot slot, const Token& name);

  bool takesMark(std::string_view mark);
  bool takesName(std::string_view name);
  void expectMark(std::string_view mark, std::string_view after);
  void comma() { takesMark(","); }
  [[noreturn]] void fail(const Token& at, const std::string& what, const std::string& hint = {});
  [[noreturn]] void expected(std::string_view what, const std::string& hint = {});
  SourcePlace place(const Token& at) const;
  void leaveOut(const Token& at, const std::string& what, const std::string& hint = {});

  // --- expressions (pov_expressions.cpp) ---
  /// A value that may stand behind #declare NAME =; elements of an array may lack commas, so they compare
  /// nothing.
  Value anyValue(bool compares = true);
  Numbers expression(bool compares = false);
  Numbers binary(int least, Numbers left, bool compares);
  Numbers unary(bool compares);
  Numbers primary();
  Numbers postfix(Numbers value);
  Numbers call(const Token& name);
  Numbers vectorLiteral();
  Real number(bool compares = false);
  Vec3 vector();
  int whole();
  bool flag();
  Numbers color();
  Color plainColor();
  std::string text();
  bool startsText();
  std::string stringFunction(const Token& name);
  bool startsNumber();
  Value* valueOf(const Token& name);
  Slot namedSlot(const Token& name);
  Value arrayValue();
  std::shared_ptr<SplineCurve> spline();
  Ref<Formula> function();
  Formula::Part formulaPart(int least, std::vector<Formula::Step>& steps,
                            const std::vector<std::string>& parameters);
  Formula::Part formulaUnary(std::vector<Formula::Step>& steps, const std::vector<std::string>& parameters);
  Formula::Part formulaPrimary(std::vector<Formula::Step>& steps, const std::vector<std::string>& parameters);
  bool isDefined(const Token& name);
  /// The element of an array that is named next, if it is one of those; null, and nothing read, without an
  /// array.
  template <class T>
  Ref<T> element() {
    const Token name = peek();
    const Value* value = name.is(Token::Kind::name) ? valueOf(name) : nullptr;
    if (!value || !value->as<std::shared_ptr<Array>>()) return nullptr;
    next();
    const Slot slot = namedSlot(name);
    const auto* held = slot ? slot->as<Ref<T>>() : nullptr;
    if (!held)
      fail(name, "\"" + std::string(name.text) + "\" has " + std::string(slot ? kindOf(*slot) : "nothing") +
                     " there");
    return *held;
  }
  /// The node of the name that stands in place of a block; null, and nothing read, before a block. `what`:
  /// "a finish".
  template <class T>
  Ref<T> namedInPlace(const std::string& what) {
    if (peek().isMark("{")) return nullptr;
    const Token name = next();
    const Slot slot = namedSlot(name);
    const auto* held = slot ? slot->as<Ref<T>>() : nullptr;
    if (!held) fail(name, "expected " + what + ", found " + describe(name));
    return *held;
  }
  /// Copies the node of a name to `node`, if one is next.
  template <class T>
  bool takesNamed(T& node) {
    const Token name = peek();
    const Value* value = name.is(Token::Kind::name) ? valueOf(name) : nullptr;
    const auto* held = value ? value->as<Ref<T>>() : nullptr;
    if (!held) return false;
    node = **held;
    next();
    return true;
  }
  Numbers query(const Token& function);
  Numbers colorAt(const Ref<PigmentNode>& pigment, const Vec3& p);

  // --- objects (pov_objects.cpp, pov_shapes.cpp) ---
  void statement();
  bool startsObject();
  std::shared_ptr<Node> object();
  void modifiers(Node& node);
  bool modifier(Node& node);
  bool transform(Affine& by);
  Affine transformBlock();
  void move(Node& node, const Affine& by);
  std::shared_ptr<Node> csg(const Token& at, Node::Kind kind);
  bool shape(const Token& keyword, Node& node);
  void box(Node& node);
  void cone(Node& node, bool cylinder);
  void planeShape(Node& node);
  void disc(Node& node);
  void torus(Node& node);
  void blob(Node& node);
  void lathe(Node& node, bool sor);
  void prism(Node& node);
  void sphereSweep(Node& node);
  void quadric(Node& node);
  void poly(Node& node, int order);
  void isosurface(Node& node);
  void heightField(Node& node, const Token& at);
  void julia(Node& node);
  void patch(Node& node);
  void polygon(Node& node);
  void triangle(Node& node, bool smooth);
  void mesh(Node& node);
  void mesh2(Node& node);
  void parametric(Node& node, const Token& at);
  void textShape(Node& node, const Token& at);
  std::string readNamed(const Token& at, const std::string& name);
  void omitBlock();
  std::shared_ptr<Node> lightSource();
  std::vector<Ref<Node>> objectsIn();

  // --- textures (pov_textures.cpp) ---
  Ref<TextureNode> texture();
  void textureBody(TextureNode::Layer& layer, bool& isMap);
  Ref<PigmentNode> pigment(std::string_view map = "pigment_map");
  void pigmentBody(PigmentNode& p);
  Ref<NormalNode> normal();
  Ref<FinishNode> finish();
  Ref<InteriorNode> interior();
  Ref<MaterialNode> material();
  MediaNode media();
  bool pattern(PatternNode& p);
  bool patternModifier(PatternNode& p, Affine& at);
  ImageNode image();
  void findPicture(const Token& at, ImageNode& image);
  Ref<MapNode> map(const Token& keyword);
  bool startsPattern(const Token& t) const;

  // --- the camera and the environment (pov_camera.cpp) ---
  CameraNode camera();
  void globalSettings();
  FogNode fog();
  SkyNode skySphere();

  static constexpr std::size_t kMostFrames = 400;
  static constexpr std::int64_t kMostSteps = 200'000'000;

  std::string file_;
  InputFiles& inputs_;
  SceneTime& time_;
  Messages& messages_;
  WarningsByKind warnings_;
  std::vector<std::unique_ptr<Source>> sources_;
  std::map<std::string, const Source*> known_;
  std::vector<Frame> frames_;
  std::vector<Block> blocks_;
  std::vector<Scope> scopes_;
  Token ahead_;
  bool hasAhead_ = false;
  int nest_ = 0;  ///< brackets that are open
  struct Stop {
    bool active = false;
    int nest = 0;
    std::size_t frames = 0;
    bool begun = false;  ///< a token of the value was read
  } stop_;
  Real frame_ = 0;  ///< value of frame_number and its like
  bool asksFrame_ = false;
  std::size_t debugLines_ = 0;  ///< lines of #debug that were reported
  Omissions* left_ = nullptr;   ///< omissions of the texture that is read
  int depth_ = 0;               ///< expressions and objects, one within the other
  std::int64_t steps_ = 0;
  std::int64_t madeObjects_ = 0;
  std::vector<std::uint64_t> seeds_;
  std::map<const Node*, std::pair<Ref<Node>, std::shared_ptr<const Query>>> queries_;
  std::map<const PigmentNode*, std::pair<Ref<PigmentNode>, Paint>> paints_;
  World world_;
  Ref<PigmentNode> defaultPigment_;
  Ref<NormalNode> defaultNormal_;
  Ref<FinishNode> defaultFinish_;
};

}  // namespace trace::pov
