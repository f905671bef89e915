// Height fields: landscapes from pictures and functions. Source: the POV-Ray 3.7 reference, section 2.4.1.5.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "formats/pov/pov_formula.h"
#include "formats/pov/pov_paint.h"
#include "formats/pov/pov_reader.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "image/codecs/codec.h"

namespace trace::pov {
namespace {

constexpr int kMostSide = 4096;

Real greyOf(const Color& c) { return 0.297 * c.r + 0.589 * c.g + 0.114 * c.b; }

/// The function at a point, or the grey of its pigment there; nothing where neither can be computed.
std::function<std::optional<Real>(const Vec3&)> heightOf(const Formula& formula, WarningsByKind& warnings) {
  const Ref<PigmentNode> pigment = formula.onlyPigment();
  if (!pigment)
    return [&formula](const Vec3& p) {
      const Real at[3] = {p.x, p.y, p.z};
      return formula.at(at, 3);
    };
  const Paint paint =
      Painter(warnings).paint(*pigment, [&](const Numbers& c) { return Color(formula.ofColor(c)); });
  return [paint](const Vec3& p) -> std::optional<Real> {
    const TexturePlace place{.point = p, .uv = {}, .uvX = {}, .uvY = {}, .pointX = {}, .pointY = {}};
    return greyOf(paint.texture ? paint.scale * paint.texture->at(place) : paint.scale);
  };
}

/// Over x and y from 0 to 1, as POV-Ray makes a picture of a function.
std::shared_ptr<HeightGrid> gridOf(const Formula& formula, int width, int height, WarningsByKind& warnings) {
  const auto at = heightOf(formula, warnings);
  auto grid = std::make_shared<HeightGrid>(width, height);
  for (int y = 0; y < height; ++y) {
    checkBudget();
    for (int x = 0; x < width; ++x) {
      const std::optional<Real> value = at({(x + 0.5) / width, 1 - (y + 0.5) / height, 0});
      if (!value) return nullptr;
      grid->at(x, height - 1 - y) = static_cast<float>(std::clamp(*value, 0.0, 1.0));
    }
  }
  return grid;
}

/// Over x and z from 0 to 1; what lies wholly below the floor is left out.
Shape meshOf(const HeightGrid& grid, const HeightField& said) {
  auto mesh = std::make_shared<MeshData>();
  const auto number = [&](int x, int y) { return static_cast<std::uint32_t>(y * grid.columns + x); };
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      mesh->points.push_back({static_cast<float>(x) / static_cast<float>(grid.columns - 1), grid.at(x, y),
                              static_cast<float>(y) / static_cast<float>(grid.rows - 1)});
  const auto add = [&](const Triangle& t) {
    const bool seen =
        std::any_of(t.begin(), t.end(), [&](std::uint32_t i) { return !(mesh->points[i].y < said.floor); });
    if (seen) mesh->triangles.push_back(t);
  };
  for (int y = 0; y + 1 < grid.rows; ++y)
    for (int x = 0; x + 1 < grid.columns; ++x) {
      add({number(x, y), number(x, y + 1), number(x + 1, y)});
      add({number(x + 1, y), number(x, y + 1), number(x + 1, y + 1)});
    }
  mesh->generateNormals = said.smooth;
  mesh->twoSided = true;
  return Mesh{std::move(mesh)};
}

}  // namespace

void Reader::heightField(Node& node, const Token& at) {
  HeightField shape;
  shape.floor = 0;
  std::string file;
  std::shared_ptr<const HeightGrid> rough;
  if (takesName("function")) {
    const int width = std::clamp(whole(), 2, kMostSide);
    comma();
    const int height = std::clamp(whole(), 2, kMostSide);
    const Ref<Formula> formula = function();
    if (auto grid = gridOf(*formula, width, height, warnings())) {
      rough = std::move(grid);
    } else {
      leaveOut(at, "a height_field of a function that cannot be evaluated");
      node.kind = Node::Kind::nothing;
    }
  } else {
    while (peek().is(Token::Kind::name) && !startsText()) next();  // the type of the file
    file = text();
  }
  for (;;) {
    if (takesName("smooth"))
      shape.smooth = flag();
    else if (takesName("water_level"))
      shape.floor = number();
    else if (takesName("gamma") || takesName("premultiplied"))
      flag();
    else
      break;
  }
  if (node.kind == Node::Kind::nothing) return;
  if (rough) {
    node.shape = meshOf(*rough, shape);
    return;
  }
  try {
    const std::string bytes = readNamed(at, file);
    const Picture picture = decodePicture(bytes, file);
    if (std::min(picture.width, picture.height) < 2 || std::max(picture.width, picture.height) > kMostSide) {
      node.kind = Node::Kind::nothing;
      return leaveOut(at, "a height_field of a picture beyond 2 to 4096 pixels a side");
    }
    auto grid = std::make_shared<HeightGrid>(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Color& c = picture.at(x, y);
        grid->at(x, picture.height - 1 - y) = static_cast<float>(greyOf(c));
      }
    shape.file = {file, std::move(grid)};
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    node.kind = Node::Kind::nothing;
    return leaveOut(at, "a height_field whose picture cannot be read", error.messages().front().what);
  }
  shape.height = 1;
  Affine m;  // x and y from -1 to 1 become x and z from 0 to 1
  m.row[0] = {0.5, 0, 0};
  m.row[1] = {0, 0, 1};
  m.row[2] = {0, 0.5, 0};
  m.offset = {0.5, 0, 0.5};
  node.shape = std::move(shape);
  node.shapeAt = m;
}

}  // namespace trace::pov
