// Thin types for eight floats and four doubles, which the traversal and the triangle test need, and four
// floats for the builder; no more than these use. The same source compiles for AVX2, for SSE2, NEON and
// WebAssembly (as halves), and for plain C++.
//
// Each instruction set has its own inline namespace, so that code compiled for one is never linked in place
// of another's. Comparisons give masks with bit i for lane i.
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trace::simd {

#if defined(__AVX2__)

inline namespace avx2 {

struct Float8 {
  __m256 v;
  static Float8 load(const float* p) { return {_mm256_load_ps(p)}; }
  static Float8 all(float x) { return {_mm256_set1_ps(x)}; }
  void store(float* p) const { _mm256_store_ps(p, v); }
};
/// a b - c; with one rounding where the instruction set has it.
inline Float8 timesMinus(Float8 a, Float8 b, Float8 c) { return {_mm256_fmsub_ps(a.v, b.v, c.v)}; }
inline Float8 min(Float8 a, Float8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Float8 max(Float8 a, Float8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline unsigned lessEqual(Float8 a, Float8 b) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}

struct Double4 {
  __m256d v;
  static Double4 load(const float* p) { return {_mm256_cvtps_pd(_mm_load_ps(p))}; }
  static Double4 all(double x) { return {_mm256_set1_pd(x)}; }
};
inline Double4 operator-(Double4 a, Double4 b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline Double4 operator+(Double4 a, Double4 b) { return {_mm256_add_pd(a.v, b.v)}; }
inline Double4 operator*(Double4 a, Double4 b) { return {_mm256_mul_pd(a.v, b.v)}; }
inline Double4 operator/(Double4 a, Double4 b) { return {_mm256_div_pd(a.v, b.v)}; }
inline Double4 abs(Double4 a) { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v)}; }
inline unsigned lessEqual(Double4 a, Double4 b) {
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)));
}

}  // namespace avx2

#elif defined(__SSE2__)

inline namespace sse2 {

struct Float4 {
  __m128 v;
  static Float4 loadAnywhere(const float* p) { return {_mm_loadu_ps(p)}; }
  static Float4 all(float x) { return {_mm_set1_ps(x)}; }
  void store(float* p) const { _mm_store_ps(p, v); }
  /// Towards zero.
  void storeWhole(int* p) const { _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm_cvttps_epi32(v)); }
};
inline Float4 operator+(Float4 a, Float4 b) { return {_mm_add_ps(a.v, b.v)}; }
inline Float4 operator-(Float4 a, Float4 b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Float4 operator*(Float4 a, Float4 b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Float4 min(Float4 a, Float4 b) { return {_mm_min_ps(a.v, b.v)}; }
inline Float4 max(Float4 a, Float4 b) { return {_mm_max_ps(a.v, b.v)}; }

struct Float8 {
  __m128 lo, hi;
  static Float8 load(const float* p) { return {_mm_load_ps(p), _mm_load_ps(p + 4)}; }
  static Float8 all(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
  void store(float* p) const { _mm_store_ps(p, lo), _mm_store_ps(p + 4, hi); }
};
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
  static Double4 load(const float* p) {
    const __m128 x = _mm_load_ps(p);
    return {_mm_cvtps_pd(x), _mm_cvtps_pd(_mm_movehl_ps(x, x))};
  }
  static Double4 all(double x) { return {_mm_set1_pd(x), _mm_set1_pd(x)}; }
};
inline Double4 operator-(Double4 a, Double4 b) { return {_mm_sub_pd(a.lo, b.lo), _mm_sub_pd(a.hi, b.hi)}; }
inline Double4 operator+(Double4 a, Double4 b) { return {_mm_add_pd(a.lo, b.lo), _mm_add_pd(a.hi, b.hi)}; }
inline Double4 operator*(Double4 a, Double4 b) { return {_mm_mul_pd(a.lo, b.lo), _mm_mul_pd(a.hi, b.hi)}; }
inline Double4 operator/(Double4 a, Double4 b) { return {_mm_div_pd(a.lo, b.lo), _mm_div_pd(a.hi, b.hi)}; }
inline Double4 abs(Double4 a) {
  const __m128d sign = _mm_set1_pd(-0.0);
  return {_mm_andnot_pd(sign, a.lo), _mm_andnot_pd(sign, a.hi)};
}
inline unsigned lessEqual(Double4 a, Double4 b) {
  return static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(a.lo, b.lo)) |
                               _mm_movemask_pd(_mm_cmple_pd(a.hi, b.hi)) << 2);
}

}  // namespace sse2

#else  // lanes as arrays: compilers turn these loops into NEON or WebAssembly SIMD where it is switched on

inline namespace plain {

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
  static Lanes loadAnywhere(const float* p) { return load(p); }
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
template <class T, int N>
unsigned lessEqual(const Lanes<T, N>& a, const Lanes<T, N>& b) {
  unsigned mask = 0;
  for (int i = 0; i < N; ++i) mask |= (a.v[i] <= b.v[i] ? 1u : 0u) << i;
  return mask;
}
template <class T, int N>
Lanes<T, N> timesMinus(const Lanes<T, N>& a, const Lanes<T, N>& b, const Lanes<T, N>& c) {
  return a * b - c;
}
using Float4 = Lanes<float, 4>;
using Float8 = Lanes<float, 8>;
using Double4 = Lanes<double, 4>;

}  // namespace plain

#endif

}  // namespace trace::simd
