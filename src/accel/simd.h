// Thin types for four and eight floats and four doubles, as far as the traversal, the triangle test and the
// builder need them. The same source compiles for AVX-512 and AVX2, for SSE2 (as halves), and for plain C++,
// which compilers turn into NEON or WebAssembly SIMD.
//
// Each instruction set has its own inline namespace, so that code compiled for one is never linked in place
// of another's. Comparisons give masks with bit i for lane i.
#pragma once

#if defined(__AVX512VL__)  // the lanes of AVX2 with twice the registers, so that a ray's numbers stay in them
#include <immintrin.h>
#define TRACE_LANES avx512
#elif defined(__AVX2__)
#include <immintrin.h>
#define TRACE_LANES avx2
#elif defined(__SSE2__)
#include <emmintrin.h>
#define TRACE_LANES sse2
#else
#define TRACE_LANES plain
#endif

namespace trace::simd {

#if defined(__SSE2__)

inline namespace TRACE_LANES {

struct Float4 {
  __m128 v;
  static Float4 load(const float* p) { return {_mm_load_ps(p)}; }
  static Float4 all(float x) { return {_mm_set1_ps(x)}; }
  static Float4 of(float x, float y, float z) { return {_mm_setr_ps(x, y, z, 0)}; }
  /// x y z 0, of four.
  static Float4 loadThree(const float* p) {
    return {_mm_and_ps(_mm_load_ps(p), _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0)))};
  }
  /// x y z and a fourth lane that means nothing.
  static Float4 narrow(double x, double y, double z) {
    return {_mm_movelh_ps(_mm_cvtpd_ps(_mm_set_pd(y, x)), _mm_cvtpd_ps(_mm_set_pd(z, z)))};
  }
  static Float4 ofWhole(const int* p) {
    return {_mm_cvtepi32_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(p)))};
  }
  void store(float* p) const { _mm_store_ps(p, v); }
  /// Towards zero.
  void storeWhole(int* p) const { _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm_cvttps_epi32(v)); }
};
inline Float4 operator+(Float4 a, Float4 b) { return {_mm_add_ps(a.v, b.v)}; }
inline Float4 operator-(Float4 a, Float4 b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Float4 operator*(Float4 a, Float4 b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Float4 operator/(Float4 a, Float4 b) { return {_mm_div_ps(a.v, b.v)}; }
/// a b + c and a b - c; with one rounding where the instruction set has it.
#if defined(__AVX2__)
inline Float4 timesPlus(Float4 a, Float4 b, Float4 c) { return {_mm_fmadd_ps(a.v, b.v, c.v)}; }
inline Float4 timesMinus(Float4 a, Float4 b, Float4 c) { return {_mm_fmsub_ps(a.v, b.v, c.v)}; }
#else
inline Float4 timesPlus(Float4 a, Float4 b, Float4 c) { return a * b + c; }
inline Float4 timesMinus(Float4 a, Float4 b, Float4 c) { return a * b - c; }
#endif
inline Float4 min(Float4 a, Float4 b) { return {_mm_min_ps(a.v, b.v)}; }
inline Float4 max(Float4 a, Float4 b) { return {_mm_max_ps(a.v, b.v)}; }
inline Float4 abs(Float4 a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0f), a.v)}; }
inline Float4 withSign(Float4 size, Float4 sign) {
  return {_mm_or_ps(abs(size).v, _mm_and_ps(_mm_set1_ps(-0.0f), sign.v))};
}
inline unsigned lessEqual(Float4 a, Float4 b) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v)));
}
/// x where a < b, else y.
inline Float4 whereLess(Float4 a, Float4 b, Float4 x, Float4 y) {
  const __m128 less = _mm_cmplt_ps(a.v, b.v);
  return {_mm_or_ps(_mm_and_ps(less, x.v), _mm_andnot_ps(less, y.v))};
}
inline Float4 truncated(Float4 a) { return {_mm_cvtepi32_ps(_mm_cvttps_epi32(a.v))}; }
inline unsigned signs(Float4 a) { return static_cast<unsigned>(_mm_movemask_ps(a.v)); }
/// 1 where x is at or after the edge, else 0.
inline Float4 step(Float4 edge, Float4 x) { return {_mm_and_ps(_mm_cmple_ps(edge.v, x.v), _mm_set1_ps(1))}; }
/// y z x, and the fourth lane stays.
inline Float4 rotate(Float4 a) { return {_mm_shuffle_ps(a.v, a.v, _MM_SHUFFLE(3, 0, 2, 1))}; }
inline float first(Float4 a) { return _mm_cvtss_f32(a.v); }
/// The x, the y and the z of all four.
inline void transpose(Float4 a, Float4 b, Float4 c, Float4 d, Float4* out) {
  const __m128 ab = _mm_unpacklo_ps(a.v, b.v), cd = _mm_unpacklo_ps(c.v, d.v);
  out[0] = {_mm_movelh_ps(ab, cd)};
  out[1] = {_mm_movehl_ps(cd, ab)};
  out[2] = {_mm_movelh_ps(_mm_unpackhi_ps(a.v, b.v), _mm_unpackhi_ps(c.v, d.v))};
}

}  // namespace TRACE_LANES

#endif

#if defined(__AVX2__)

inline namespace TRACE_LANES {

struct Float8 {
  __m256 v;
  static Float8 load(const float* p) { return {_mm256_load_ps(p)}; }
  static Float8 all(float x) { return {_mm256_set1_ps(x)}; }
  void store(float* p) const {
    _mm_store_ps(p, _mm256_castps256_ps128(v));
    _mm_store_ps(p + 4, _mm256_extractf128_ps(v, 1));
  }
};
/// A lane of four in all eight.
template <int kLane>
Float8 spread(Float4 a) {
  if constexpr (kLane == 0)
    return {_mm256_broadcastss_ps(a.v)};
  else
    return {_mm256_permutevar8x32_ps(_mm256_castps128_ps256(a.v), _mm256_set1_epi32(kLane))};
}
inline Float8 timesMinus(Float8 a, Float8 b, Float8 c) { return {_mm256_fmsub_ps(a.v, b.v, c.v)}; }
inline Float8 min(Float8 a, Float8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Float8 max(Float8 a, Float8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline unsigned lessEqual(Float8 a, Float8 b) {
#if defined(__AVX512VL__)
  unsigned mask;  // all of it is defined, but GCC clears the upper bits of an 8-bit mask once more
  __asm__("kmovw %1, %0" : "=r"(mask) : "k"(_mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)));
  return mask;
#else
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
#endif
}

struct Double4 {
  __m256d v;
  static Double4 widen(const float* p) { return {_mm256_cvtps_pd(_mm_load_ps(p))}; }
  static Double4 all(double x) { return {_mm256_set1_pd(x)}; }
  void store(double* p) const { _mm256_store_pd(p, v); }
};
inline Double4 operator+(Double4 a, Double4 b) { return {_mm256_add_pd(a.v, b.v)}; }
inline Double4 operator-(Double4 a, Double4 b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline Double4 operator*(Double4 a, Double4 b) { return {_mm256_mul_pd(a.v, b.v)}; }
inline Double4 operator/(Double4 a, Double4 b) { return {_mm256_div_pd(a.v, b.v)}; }
inline Double4 min(Double4 a, Double4 b) { return {_mm256_min_pd(a.v, b.v)}; }
inline Double4 max(Double4 a, Double4 b) { return {_mm256_max_pd(a.v, b.v)}; }
inline Double4 sqrt(Double4 a) { return {_mm256_sqrt_pd(a.v)}; }
/// -a where the sign bit of `sign` is set, else a.
inline Double4 timesSign(Double4 a, Double4 sign) {
  return {_mm256_xor_pd(a.v, _mm256_and_pd(_mm256_set1_pd(-0.0), sign.v))};
}
inline unsigned less(Double4 a, Double4 b) {
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)));
}
inline unsigned lessEqual(Double4 a, Double4 b) {
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)));
}

}  // namespace TRACE_LANES

#elif defined(__SSE2__)

inline namespace TRACE_LANES {

struct Float8 {
  __m128 lo, hi;
  static Float8 load(const float* p) { return {_mm_load_ps(p), _mm_load_ps(p + 4)}; }
  static Float8 all(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
  void store(float* p) const {
    _mm_store_ps(p, lo);
    _mm_store_ps(p + 4, hi);
  }
};
template <int kLane>
Float8 spread(Float4 a) {
  const __m128 lanes = _mm_shuffle_ps(a.v, a.v, kLane * 0x55);
  return {lanes, lanes};
}
inline Float8 timesMinus(Float8 a, Float8 b, Float8 c) {
  return {_mm_sub_ps(_mm_mul_ps(a.lo, b.lo), c.lo), _mm_sub_ps(_mm_mul_ps(a.hi, b.hi), c.hi)};
}
inline Float8 min(Float8 a, Float8 b) { return {_mm_min_ps(a.lo, b.lo), _mm_min_ps(a.hi, b.hi)}; }
inline Float8 max(Float8 a, Float8 b) { return {_mm_max_ps(a.lo, b.lo), _mm_max_ps(a.hi, b.hi)}; }
inline unsigned lessEqual(Float8 a, Float8 b) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.lo, b.lo)) |
                               _mm_movemask_ps(_mm_cmple_ps(a.hi, b.hi)) << 4);
}

struct Double4 {
  __m128d lo, hi;
  static Double4 widen(const float* p) {
    const __m128 f = _mm_load_ps(p);
    return {_mm_cvtps_pd(f), _mm_cvtps_pd(_mm_movehl_ps(f, f))};
  }
  static Double4 all(double x) { return {_mm_set1_pd(x), _mm_set1_pd(x)}; }
  void store(double* p) const {
    _mm_store_pd(p, lo);
    _mm_store_pd(p + 2, hi);
  }
};
inline Double4 operator+(Double4 a, Double4 b) { return {_mm_add_pd(a.lo, b.lo), _mm_add_pd(a.hi, b.hi)}; }
inline Double4 operator-(Double4 a, Double4 b) { return {_mm_sub_pd(a.lo, b.lo), _mm_sub_pd(a.hi, b.hi)}; }
inline Double4 operator*(Double4 a, Double4 b) { return {_mm_mul_pd(a.lo, b.lo), _mm_mul_pd(a.hi, b.hi)}; }
inline Double4 operator/(Double4 a, Double4 b) { return {_mm_div_pd(a.lo, b.lo), _mm_div_pd(a.hi, b.hi)}; }
inline Double4 min(Double4 a, Double4 b) { return {_mm_min_pd(a.lo, b.lo), _mm_min_pd(a.hi, b.hi)}; }
inline Double4 max(Double4 a, Double4 b) { return {_mm_max_pd(a.lo, b.lo), _mm_max_pd(a.hi, b.hi)}; }
inline Double4 sqrt(Double4 a) { return {_mm_sqrt_pd(a.lo), _mm_sqrt_pd(a.hi)}; }
inline Double4 timesSign(Double4 a, Double4 sign) {
  const __m128d minus = _mm_set1_pd(-0.0);
  return {_mm_xor_pd(a.lo, _mm_and_pd(minus, sign.lo)), _mm_xor_pd(a.hi, _mm_and_pd(minus, sign.hi))};
}
inline unsigned less(Double4 a, Double4 b) {
  return static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(a.lo, b.lo)) |
                               _mm_movemask_pd(_mm_cmplt_pd(a.hi, b.hi)) << 2);
}
inline unsigned lessEqual(Double4 a, Double4 b) {
  return static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(a.lo, b.lo)) |
                               _mm_movemask_pd(_mm_cmple_pd(a.hi, b.hi)) << 2);
}

}  // namespace TRACE_LANES

#else  // lanes as arrays: compilers turn these loops into NEON or WebAssembly SIMD where it is switched on

inline namespace TRACE_LANES {

template <class T, int N>
struct Lanes {
  T v[N];
  static Lanes load(const float* p) {
    Lanes r;
    for (int i = 0; i < N; ++i) r.v[i] = p[i];
    return r;
  }
  static Lanes all(T x) {
    Lanes r;
    for (int i = 0; i < N; ++i) r.v[i] = x;
    return r;
  }
  static Lanes of(float x, float y, float z) { return {x, y, z, 0}; }
  static Lanes loadThree(const float* p) { return {p[0], p[1], p[2], 0}; }
  static Lanes ofWhole(const int* p) {
    Lanes r;
    for (int i = 0; i < N; ++i) r.v[i] = static_cast<T>(p[i]);
    return r;
  }
  static Lanes widen(const float* p) { return load(p); }
  static Lanes narrow(double x, double y, double z) {
    return {static_cast<T>(x), static_cast<T>(y), static_cast<T>(z), static_cast<T>(z)};
  }
  void storeWhole(int* p) const {
    for (int i = 0; i < N; ++i) p[i] = static_cast<int>(v[i]);
  }
  void store(T* p) const {
    for (int i = 0; i < N; ++i) p[i] = v[i];
  }
};
template <class T, int N, class F>
Lanes<T, N> map(const Lanes<T, N>& a, const Lanes<T, N>& b, F f) {
  Lanes<T, N> r;
  for (int i = 0; i < N; ++i) r.v[i] = f(a.v[i], b.v[i]);
  return r;
}
template <class T, int N>
Lanes<T, N> operator-(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  return map(a, b, [](T x, T y) { return x - y; });
}
template <class T, int N>
Lanes<T, N> operator+(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  return map(a, b, [](T x, T y) { return x + y; });
}
template <class T, int N>
Lanes<T, N> operator*(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  return map(a, b, [](T x, T y) { return x * y; });
}
template <class T, int N>
Lanes<T, N> operator/(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  return map(a, b, [](T x, T y) { return x / y; });
}
template <class T, int N>
Lanes<T, N> min(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  return map(a, b, [](T x, T y) { return x < y ? x : y; });
}
template <class T, int N>
Lanes<T, N> max(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  return map(a, b, [](T x, T y) { return x > y ? x : y; });
}
template <class T, int N>
Lanes<T, N> abs(const Lanes<T, N>& a) {
  return map(a, a, [](T x, T) { return x < 0 ? -x : x; });
}
template <int N>
Lanes<double, N> sqrt(const Lanes<double, N>& a) {
  return map(a, a, [](double x, double) { return __builtin_sqrt(x); });
}
template <class T, int N>
unsigned less(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  unsigned mask = 0;
  for (int i = 0; i < N; ++i) mask |= (a.v[i] < b.v[i] ? 1u : 0u) << i;
  return mask;
}
template <class T, int N>
unsigned lessEqual(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  unsigned mask = 0;
  for (int i = 0; i < N; ++i) mask |= (a.v[i] <= b.v[i] ? 1u : 0u) << i;
  return mask;
}
template <class T, int N>
Lanes<T, N> withSign(const Lanes<T, N>& size, const Lanes<T, N>& sign) {
  return map(abs(size), sign, [](T x, T y) { return __builtin_signbit(y) ? -x : x; });
}
template <class T, int N>
Lanes<T, N> timesSign(const Lanes<T, N>& a, const Lanes<T, N>& sign) {
  return map(a, sign, [](T x, T y) { return __builtin_signbit(y) ? -x : x; });
}
template <class T, int N>
unsigned signs(const Lanes<T, N>& a) {
  unsigned mask = 0;
  for (int i = 0; i < N; ++i) mask |= (__builtin_signbit(a.v[i]) ? 1u : 0u) << i;
  return mask;
}
template <class T>
Lanes<T, 4> step(const Lanes<T, 4>& edge, const Lanes<T, 4>& x) {
  return map(edge, x, [](T e, T at) { return static_cast<T>(e <= at ? 1 : 0); });
}
template <class T>
Lanes<T, 4> whereLess(const Lanes<T, 4>& a, const Lanes<T, 4>& b, const Lanes<T, 4>& x,
                      const Lanes<T, 4>& y) {
  Lanes<T, 4> r;
  for (int i = 0; i < 4; ++i) r.v[i] = a.v[i] < b.v[i] ? x.v[i] : y.v[i];
  return r;
}
template <class T>
Lanes<T, 4> truncated(const Lanes<T, 4>& a) {
  return map(a, a, [](T x, T) { return static_cast<T>(static_cast<int>(x)); });
}
template <class T>
void transpose(const Lanes<T, 4>& a, const Lanes<T, 4>& b, const Lanes<T, 4>& c, const Lanes<T, 4>& d,
               Lanes<T, 4>* out) {
  for (int i = 0; i < 3; ++i) out[i] = {a.v[i], b.v[i], c.v[i], d.v[i]};
}
template <class T>
Lanes<T, 4> rotate(const Lanes<T, 4>& a) {
  return {a.v[1], a.v[2], a.v[0], a.v[3]};
}
template <class T>
T first(const Lanes<T, 4>& a) {
  return a.v[0];
}
template <int kLane, class T>
Lanes<T, 8> spread(const Lanes<T, 4>& a) {
  return Lanes<T, 8>::all(a.v[kLane]);
}
template <class T, int N>
Lanes<T, N> timesPlus(const Lanes<T, N>& a, const Lanes<T, N>& b, const Lanes<T, N>& c) {
  return a * b + c;
}
template <class T, int N>
Lanes<T, N> timesMinus(const Lanes<T, N>& a, const Lanes<T, N>& b, const Lanes<T, N>& c) {
  return a * b - c;
}
using Float4 = Lanes<float, 4>;
using Float8 = Lanes<float, 8>;
using Double4 = Lanes<double, 4>;

}  // namespace TRACE_LANES

#endif

}  // namespace trace::simd
