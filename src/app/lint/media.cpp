// The checks of media that fill bodies, and of bodies in which light spreads.

#include "app/lint/checks.h"
#include "base/budget.h"
#include "shading/materials/subsurface.h"
#include "shading/medium.h"

namespace trace::lint_checks {
namespace {

bool isFilled(const LintScene& s, std::uint32_t object) {
  for (const World::MediumBody& body : s.world.media())
    if (body.object == object) return true;
  return false;
}

/// Some medium is meant, whether or not there is any of it.
bool meansMedium(const Material& m) {
  const Material plain;
  return m.mediumDensity > 0 || m.mediumScatters != plain.mediumScatters ||
         m.mediumAbsorbs != plain.mediumAbsorbs || m.mediumGlows != plain.mediumGlows;
}

/// There is nothing of the medium at any place of a grid in the bounds of the body.
bool isEmpty(const LintScene& s, const World::MediumBody& body) {
  constexpr int kSide = 24;
  const Vec3 size = body.bounds.size();
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    checkBudget();
    const Vec3 part{(i % kSide + 0.5) / kSide, (i / kSide % kSide + 0.5) / kSide,
                    (i / (kSide * kSide) + 0.5) / kSide};
    const Vec3 place = body.bounds.low + Vec3{size.x * part.x, size.y * part.y, size.z * part.z};
    const Medium medium = s.world.mediumAt(body, place);
    if (!isBlack(medium.loses()) || !isBlack(medium.glows)) return false;
  }
  return true;
}

}  // namespace

void mediumUnseen(const LintScene& s, Findings& findings) {
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i) {
    const Material& material = s.scene.materials[s.scene.objects[i].material];
    if (!(material.mediumDensity > 0) || isFilled(s, i)) continue;
    const bool hidden = s.world.opaque(i);
    warn(findings, "medium-unseen", placeOf(s, i),
         quoted(s, i) + (hidden ? " is opaque: its medium is not visible"
                                : " does not enclose a finite space, so it has no medium"),
         hidden ? "opacity = 0 removes its surface; transmissive makes it glass"
                : "give the medium to a closed object, such as a box or a sphere");
  }
}

void mediumEmpty(const LintScene& s, Findings& findings) {
  for (const World::MediumBody& body : s.world.media()) {
    if (!isEmpty(s, body)) continue;
    warn(findings, "medium-empty", placeOf(s, body.object),
         "the medium in " + quoted(s, body.object) +
             " has no scattering, absorption or emission anywhere: it is not visible",
         "its texture may lie outside of the object, in whose own space it is evaluated; or give it "
         "medium_scatters, medium_absorbs or medium_glows");
  }
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i) {
    const Material& material = s.scene.materials[s.scene.objects[i].material];
    if (material.mediumDensity > 0 || !meansMedium(material)) continue;
    warn(findings, "medium-empty", placeOf(s, i),
         quoted(s, i) + " has fields of a medium, but its medium_density is 0: there is none",
         "medium_density = 1 uses the other fields unchanged");
  }
}

void subsurfaceOpen(const LintScene& s, Findings& findings) {
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i) {
    const Material& material = s.scene.materials[s.scene.objects[i].material];
    const auto* model = material.model.as<Subsurface>();
    if (!model || s.world.solid(i)) continue;
    warn(findings, "subsurface-open", placeOf(s, i),
         quoted(s, i) + " encloses nothing, but has subsurface scattering: " +
             (model->spreading == Spreading::walk ? "a random walk finds no way out, and it stays dark"
                                                  : "it is lit as if it were thick"),
         "make it a closed object; use Lambert's model for a leaf or a sheet of paper");
  }
}

}  // namespace trace::lint_checks
