// Shapes of polygons: normals, materials and texture coordinates bound to their corners.
#include <cmath>
#include <optional>
#include <utility>

#include "formats/inventor/inventor_reader.h"

namespace trace::inventor {

Reader::MeshKey Reader::keyOf(const Values& v, const State& s) {
  const int flags = (s.ordered ? 1 : 0) + (s.counterClockwise ? 2 : 0) + (s.solid ? 4 : 0);
  return {&v.node(),         v.env(),         s.points.get(), s.normals.get(), s.uvs.get(),  s.paint.get(),
          s.materialBinding, s.normalBinding, s.uvBinding,    flags,           s.creaseAngle};
}

bool Reader::addAgain(const Values& v, const State& state) {
  const auto found = meshes_.find(keyOf(v, state));
  if (found == meshes_.end()) return false;
  if (!found->second.data->triangles.empty()) add(v, state, found->second);
  return true;
}

void Reader::mesh(const Values& v, const State& state, const Surface& surface, const Bindings& bind) {
  constexpr std::size_t kCornersOfWork = 32;
  spend(surface.outline.points.size() / kCornersOfWork, v.node());
  const Outline& outline = surface.outline;
  if (outline.bad > 0)
    warn(v.node(),
         std::to_string(outline.bad) +
             " faces are left out: of fewer than three points, or of points "
             "that are not there",
         "faces");
  if (outline.counts.empty()) return;
  Faces faces;
  faces.points = surface.points;
  faces.counts = outline.counts;
  faces.counterClockwise = state.counterClockwise;
  faces.creaseAngle = state.creaseAngle;
  const std::vector<Vec3>& normals = *state.normals;
  const std::vector<Vec2>& uvs = surface.uvs.empty() ? *state.uvs : surface.uvs;
  faces.hasNormals = bind.normal.by != Binding::By::nothing && !normals.empty();
  faces.hasMaterials = bind.material.by != Binding::By::nothing && bind.material.by != Binding::By::all &&
                       state.paint->count() > 1;
  const bool project = uvs.empty() && state.paint->picture;
  faces.hasUvs = !uvs.empty() || project;
  const std::optional<BoxUvs> projected = project ? std::optional(BoxUvs(surface)) : std::nullopt;
  const Binding bySlot{Binding::By::slot, nullptr}, byPoint{Binding::By::point, nullptr};
  const Binding& uvBinding = !surface.uvs.empty()                 ? bySlot
                             : bind.uv.by != Binding::By::nothing ? bind.uv
                                                                  : byPoint;
  std::size_t corner = 0, missing = 0;
  for (std::size_t face = 0; face < faces.counts.size(); ++face)
    for (std::uint32_t i = 0; i < faces.counts[face]; ++i, ++corner) {
      Corner c;
      c.point = outline.points[corner];
      if (faces.hasNormals) {
        const std::size_t n = bind.normal(outline, face, corner);
        if (n >= normals.size())
          faces.hasNormals = false;
        else
          c.normal = unit(normals[n]);
      }
      if (faces.hasMaterials) {
        const std::size_t n = bind.material(outline, face, corner);
        missing += bind.material.indices && n >= state.paint->count();
        c.material = materialNumber(state, n);
      }
      if (projected) {
        c.uv = projected->of(surface.points[c.point]);
      } else if (faces.hasUvs) {
        const std::size_t n = uvBinding(outline, face, corner);
        missing += uvBinding.indices && n >= uvs.size();
        if (n < uvs.size()) c.uv = uvs[n];
      }
      faces.corners.push_back(c);
    }
  if (missing > 0)
    warn(v.node(), "corners use materials, colours or texture coordinates that are not there", "missing");
  if (bind.normal.by != Binding::By::nothing && !normals.empty() && !faces.hasNormals)
    warn(v.node(), "there are fewer normals than the faces need; they are made from the faces", "normals");
  MeshData data = meshOf(std::move(faces));
  data.twoSided = !(state.ordered && state.solid);
  repairs_.check(data, document_.place(v.node().token));
  made_ = Mesh{std::make_shared<const MeshData>(std::move(data))};
  if (!made_.data->triangles.empty()) add(v, state, made_);
}

Vec3 Reader::unit(const Vec3& v) {
  const Real l = length(v);
  return l > 0 && std::isfinite(l) ? v / l : Vec3{};
}

void Reader::faceSet(const Values& v, State& outer) {
  if (addAgain(v, outer)) return;
  State state = outer;
  if (const NodeIn at = nodeOf(v, "vertexProperty"); at.node) vertexProperty(Values(*at.node, at.env), state);
  Bindings bind;
  if (vrml2_) {
    bind = attributes(v, state);
  } else {
    const bool indexed = v.node().type.starts_with("Indexed");
    bind.normal = bindingOf(state.normalBinding, Binding::By::point, v.numbers("normalIndex"), indexed);
    bind.material = bindingOf(state.materialBinding, Binding::By::all, v.numbers("materialIndex"), indexed);
    bind.uv = bindingOf(state.uvBinding, Binding::By::point, v.numbers("textureCoordIndex"), indexed);
  }
  Surface surface;
  surface.points = *state.points;
  surface.outline = outlineOf(v, v.node().type, surface.points.size());
  mesh(v, state, surface, bind);
  remember(v, outer);
}

void Reader::remember(const Values& v, const State& outer) {
  meshes_[keyOf(v, outer)] = std::exchange(made_, {});
}

Bindings Reader::attributes(const Values& v, State& state) {
  state.ordered = true;
  state.counterClockwise = v.flag("ccw", true);
  state.solid = v.flag("solid", true);
  state.creaseAngle = v.number("creaseAngle", 0);
  if (const NodeIn at = nodeOf(v, "coord"); at.node)
    state.points = vectors(Values(*at.node, at.env), "point");
  Bindings bind;
  if (const NodeIn at = nodeOf(v, "normal"); at.node) {
    normals(Values(*at.node, at.env), state);
    bind.normal = bindingOf(v.flag("normalPerVertex", true), v.numbers("normalIndex"));
  }
  if (const NodeIn at = nodeOf(v, "texCoord"); at.node) {
    textureCoordinates(Values(*at.node, at.env), state);
    bind.uv = bindingOf(true, v.numbers("texCoordIndex"));
  }
  if (const NodeIn at = nodeOf(v, "color"); at.node) {
    const Values colors(*at.node, at.env);
    repaint(colors, state, [&](Paint& p) { p.diffuse = colors.colors("color"); });
    bind.material = bindingOf(v.flag("colorPerVertex", true), v.numbers("colorIndex"));
  }
  return bind;
}

void Reader::elevationGridNode(const Values& v, State& outer) {
  if (addAgain(v, outer)) return;
  State state = outer;
  const Bindings bind = attributes(v, state);
  Surface surface = elevationGrid(v);
  if (surface.points.empty())
    return warn(v.node(), "an ElevationGrid needs xDimension * zDimension heights, at least 2 * 2", "grid");
  if (bind.uv.by != Binding::By::nothing) surface.uvs.clear();
  mesh(v, state, surface, bind);
  remember(v, outer);
}

void Reader::extrusionNode(const Values& v, State& outer) {
  if (addAgain(v, outer)) return;
  State state = outer;
  attributes(v, state);
  Surface surface = extrusion(v);
  if (!state.paint->picture) surface.uvs.clear();
  if (surface.outline.counts.empty())
    return warn(v.node(), "an Extrusion needs a crossSection and a spine of at least 2 points", "extrusion");
  mesh(v, state, surface, {});
  remember(v, outer);
}

}  // namespace trace::inventor
