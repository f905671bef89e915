// What microfacets give back of the light that falls on them.
#include "shading/optics/microfacet.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

/// The middles of count x count cells of the square.
template <class Visit>
void overSquare(int count, const Visit& visit) {
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) visit(Vec2{(i + 0.5) / count, (j + 0.5) / count});
}

TEST(Microfacets, WhiteOnesGiveBackAllWithGrainAndWithout) {
  for (const Distribution kind : {Distribution::ggx, Distribution::beckmann})
    for (const Real roughness : {0.2, 0.4, 0.7, 1.0})
      for (const Real anisotropy : {0.0, 0.3, 0.8, 1.0}) {
        const MicrofacetLobe lobe(Microfacets::of(kind, roughness, anisotropy), Color(1));
        for (const Real cosine : {1.0, 0.7, 0.3, 0.1})
          for (const Real phi : {0.0, 0.6, 1.2, kPi / 2}) {
            const Real sine = std::sqrt(1 - cosine * cosine);
            const Vec3 eye{sine * std::cos(phi), sine * std::sin(phi), cosine};
            Real back = 0;
            constexpr int kCells = 32;
            overSquare(kCells, [&](const Vec2& u) {  // once mirrored, and several times
              const Vec3 half = lobe.facets.chosen(eye, u), light = mirroredAt(half, eye);
              if (light.z > 0) back += lobe.facets.seenAndLit(eye, light) / lobe.facets.seen(eye);
              const Vec3 even = cosineDirection(u);
              back += (lobe.value(eye, even, [](Real) { return Color(0); }).g) * kPi / even.z;
            });
            EXPECT_NEAR(back / (kCells * kCells), 1, 0.025)
                << "kind " << static_cast<int>(kind) << ", roughness " << roughness << ", anisotropy "
                << anisotropy << ", cosine " << cosine << ", angle " << phi;
          }
      }
}

TEST(Microfacets, GrainTurnedByAQuarterIsGrainSeenFromAQuarter) {
  const Microfacets along{Distribution::ggx, 0.4, 0.1}, across{Distribution::ggx, 0.1, 0.4};
  const Vec3 eye = normalize(Vec3{0.3, 0.8, 0.5}), turned{eye.y, eye.x, eye.z};
  EXPECT_EQ(microfacetAlbedo(along, eye).white, microfacetAlbedo(across, turned).white);
  EXPECT_EQ(meanMicrofacetAlbedo(along).schlick, meanMicrofacetAlbedo(across).schlick);
}

}  // namespace
}  // namespace trace::test
