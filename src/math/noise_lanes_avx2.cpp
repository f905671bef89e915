// Compiled with -mavx2; called only where the processor has it. Without fused multiplication, so that every
// sum is rounded as in noise_kernel.h.
#include <immintrin.h>

#include "math/fractal_kernel.h"
#include "math/noise_lanes.h"

namespace trace {
namespace {

constexpr std::uint32_t kOddX = axisBits(1, 0), kOddY = axisBits(1, 1), kOddZ = axisBits(1, 2);
constexpr int asInt(std::uint32_t bits) { return static_cast<int>(bits); }

__m256i mixed(__m256i v) {  // mixBits32()
  v = _mm256_mullo_epi32(_mm256_xor_si256(v, _mm256_srli_epi32(v, 16)), _mm256_set1_epi32(0x7feb352d));
  v = _mm256_mullo_epi32(_mm256_xor_si256(v, _mm256_srli_epi32(v, 15)),
                         _mm256_set1_epi32(asInt(0x846ca68bu)));
  return _mm256_xor_si256(v, _mm256_srli_epi32(v, 16));
}

/// The components of eight slopes along an axis, -1, 0 or 1, of which byte i of the table is that of slope i.
/// `chosen` holds their numbers in the lanes' highest bytes.
struct Slopes {
  __m256d low, high;
  Slopes(__m128i table, __m256i chosen) {
    const __m256i bytes = _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(table), chosen);
    const __m256i whole = _mm256_srai_epi32(bytes, 24);
    low = _mm256_cvtepi32_pd(_mm256_castsi256_si128(whole));
    high = _mm256_cvtepi32_pd(_mm256_extracti128_si256(whole, 1));
  }
};

inline __m256d plus(__m256d a, __m256d b) { return _mm256_add_pd(a, b); }
inline __m256d minus(__m256d a, __m256d b) { return _mm256_sub_pd(a, b); }
inline __m256d times(__m256d a, __m256d b) { return _mm256_mul_pd(a, b); }
inline __m256d all(Real x) { return _mm256_set1_pd(x); }

/// noise_kernel::at<3, false>(). Lanes of corners go y first, then z; there are four at either end of x.
inline Real at(const Real* point, std::uint32_t seed) {
  const __m256d p = _mm256_setr_pd(point[0], point[1], point[2], point[2]);
  constexpr Real kFar = 0x1p50;  // farther away the sum below has no room for the whole number
  const __m256d size = _mm256_andnot_pd(all(-0.0), p);
  const int isNear = _mm256_movemask_pd(_mm256_cmp_pd(size, all(kFar), _CMP_LT_OQ));
  if (isNear != 15) [[unlikely]] {
    constexpr std::int64_t kNever[3]{};
    return gradientNoise<3>({point[0], point[1], point[2]}, seed, kNever);
  }
  const __m256d whole = plus(_mm256_floor_pd(p), all(0.0)), rest = minus(p, whole);
  const __m256d fade =
      times(times(times(rest, rest), rest), plus(times(rest, minus(times(rest, all(6)), all(15))), all(10)));
  // In the lowest bits of the sum stands the whole number.
  const __m256i number = _mm256_castpd_si256(plus(whole, all(0x1.8p52)));
  const __m256i odd = _mm256_setr_epi64x(kOddX, kOddY, kOddZ, 0);
  const __m256i bits = _mm256_mul_epu32(number, odd);
  const __m128i xy = _mm256_castsi256_si128(bits), z = _mm256_extracti128_si256(bits, 1);
  const __m128i x0 = xy, y0 = _mm_shuffle_epi32(xy, 0xaa), z0 = _mm_shuffle_epi32(z, 0);
  const __m128i rows =
      _mm_add_epi32(_mm_add_epi32(_mm_set1_epi32(asInt(seed)),
                                  _mm_add_epi32(y0, _mm_setr_epi32(0, asInt(kOddY), 0, asInt(kOddY)))),
                    _mm_add_epi32(z0, _mm_setr_epi32(0, 0, asInt(kOddZ), asInt(kOddZ))));
  const __m128i ends =
      _mm_add_epi32(_mm_shuffle_epi32(x0, 0), _mm_setr_epi32(0, asInt(kOddX), 0, asInt(kOddX)));
  const __m256i hashed = mixed(_mm256_inserti128_si256(_mm256_castsi128_si256(rows), ends, 1));
  const __m256i eachRow = _mm256_permute4x64_epi64(hashed, 0x44);
  const __m256i eachEnd = _mm256_permutevar8x32_epi32(hashed, _mm256_setr_epi32(4, 4, 4, 4, 5, 5, 5, 5));
  const __m256i corner =
      _mm256_mullo_epi32(_mm256_xor_si256(eachRow, eachEnd), _mm256_set1_epi32(0x7feb352d));
  // The upper four bits choose the slope; the other bytes choose nothing.
  const __m256i chosen =
      _mm256_or_si256(_mm256_and_si256(_mm256_srli_epi32(corner, 4), _mm256_set1_epi32(0x0f000000)),
                      _mm256_set1_epi32(0x00808080));
  // kSlopes<3>: edges along x, along y, along z, and again those along x.
  const Slopes alongX(_mm_setr_epi8(0, 0, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0), chosen),
      alongY(_mm_setr_epi8(1, -1, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1, 1, -1, 1, -1), chosen),
      alongZ(_mm_setr_epi8(1, 1, -1, -1, 1, 1, -1, -1, 0, 0, 0, 0, 1, 1, -1, -1), chosen);
  const __m256d restX = _mm256_permute4x64_pd(rest, 0x00),
                restY = minus(_mm256_permute4x64_pd(rest, 0x55), _mm256_setr_pd(0, 1, 0, 1)),
                restZ = minus(_mm256_permute4x64_pd(rest, 0xaa), _mm256_setr_pd(0, 0, 1, 1));
  const __m256d low =
                    plus(plus(times(alongX.low, restX), times(alongY.low, restY)), times(alongZ.low, restZ)),
                high = plus(plus(times(alongX.high, minus(restX, all(1))), times(alongY.high, restY)),
                            times(alongZ.high, restZ));
  const auto between = [](__m256d from, __m256d to, __m256d share) {
    return plus(from, times(share, minus(to, from)));
  };
  const __m256d alongZs = between(_mm256_permute2f128_pd(low, high, 0x20),
                                  _mm256_permute2f128_pd(low, high, 0x31), _mm256_permute4x64_pd(fade, 0xaa));
  const __m256d alongYs =
      between(alongZs, _mm256_permute_pd(alongZs, 0x5), _mm256_permute4x64_pd(fade, 0x55));
  const Real from = _mm256_cvtsd_f64(alongYs), to = _mm_cvtsd_f64(_mm256_extractf128_pd(alongYs, 1));
  return from + _mm256_cvtsd_f64(fade) * (to - from);
}

Real noise(const std::array<Real, 3>& p, std::uint32_t seed) { return at(p.data(), seed); }

Real sum(const FractalSum& f, const std::array<Real, 3>& p, Real width) {
  return fractal_kernel::summedBy<false, 3>(
      f, p, width, nullptr, [](const std::array<Real, 3>& octave, std::uint32_t seed, const std::int64_t*) {
        return at(octave.data(), seed);
      });
}

}  // namespace

extern const NoiseLanes kNoiseLanesAvx2;
const NoiseLanes kNoiseLanesAvx2{noise, sum};

}  // namespace trace
