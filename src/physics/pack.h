/// Pack<N>: N floats that behave like one number.
///
/// The passes of the simulator are written once over a scalar type T. T = double serves reading and checking;
/// with T = Pack<N> every arithmetic operation handles N characters at once, lane i belonging to character i.
/// No operation moves a value from one lane to another, so lanes cannot influence each other.
///
/// Because lanes may disagree, no branch may depend on a T. Comparisons give a mask, and `select(mask, a, b)`
/// takes a where the mask is set and b elsewhere. For double the mask is a bool and the same source works.
/// The one permitted use of a mask in a branch is `any(mask)`, to skip work that would change no lane.
///
/// Rounding: +, −, ·, / and sqrt are IEEE-exact per lane and `fma` is fused wherever the target has it, so
/// the bits of a lane depend neither on N nor on the position of the lane. They differ from those of the
/// double version: compare the two by tolerance. In portable arithmetic (MIMICX_ARITHMETIC of the build,
/// docs/porting.md) nothing is fused anywhere and packs have 4 lanes, so that all machines give the same
/// bits.
#pragma once

#include <cmath>
#include <cstdint>
#if defined(__AVX2__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace mimicx::physics {

#if defined(__FMA__) && !defined(MIMICX_PORTABLE_ARITHMETIC)
#define MIMICX_FUSED 1
#endif
#if defined(__AVX512F__) && !defined(MIMICX_PORTABLE_ARITHMETIC)
#define MIMICX_LANES 16
#elif defined(__AVX2__) && !defined(MIMICX_PORTABLE_ARITHMETIC)
#define MIMICX_LANES 8
#else
#define MIMICX_LANES 4
#endif

/// Lanes of the pack that training uses on this target.
inline constexpr int kLanes = MIMICX_LANES;

/// The compiler's vector types, one specialisation per width (GCC ignores a width that depends on N).
template <int N>
struct VectorTypes;
template <>
struct VectorTypes<1> {
  typedef float Values __attribute__((vector_size(4)));
  typedef std::int32_t Mask __attribute__((vector_size(4)));
};
template <>
struct VectorTypes<4> {
  typedef float Values __attribute__((vector_size(16)));
  typedef std::int32_t Mask __attribute__((vector_size(16)));
};
template <>
struct VectorTypes<8> {
  typedef float Values __attribute__((vector_size(32)));
  typedef std::int32_t Mask __attribute__((vector_size(32)));
};
template <>
struct VectorTypes<16> {
  typedef float Values __attribute__((vector_size(64)));
  typedef std::int32_t Mask __attribute__((vector_size(64)));
};

template <int N>
struct Pack {
  static constexpr int kSize = N;
  using Values = typename VectorTypes<N>::Values;
  using Mask = typename VectorTypes<N>::Mask;

  Values v;

  Pack() = default;
  Pack(Values values) : v(values) {}
  Pack(float x) : v(x - Values{}) {}
  explicit Pack(double x) : Pack(static_cast<float>(x)) {}

  float operator[](int lane) const { return v[lane]; }
  void set(int lane, float x) { v[lane] = x; }

  friend Pack operator+(Pack a, Pack b) { return a.v + b.v; }
  friend Pack operator-(Pack a, Pack b) { return a.v - b.v; }
  friend Pack operator*(Pack a, Pack b) { return a.v * b.v; }
  friend Pack operator/(Pack a, Pack b) { return a.v / b.v; }
  friend Pack operator-(Pack a) { return -a.v; }
  Pack& operator+=(Pack b) {
    v += b.v;
    return *this;
  }
  Pack& operator-=(Pack b) {
    v -= b.v;
    return *this;
  }
  Pack& operator*=(Pack b) {
    v *= b.v;
    return *this;
  }
  friend Mask operator<(Pack a, Pack b) { return a.v < b.v; }
  friend Mask operator>(Pack a, Pack b) { return a.v > b.v; }
  friend Mask operator<=(Pack a, Pack b) { return a.v <= b.v; }
};

template <int N>
Pack<N> fma(Pack<N> a, Pack<N> b, Pack<N> c) {
#if defined(__AVX512F__) && defined(MIMICX_FUSED)
  if constexpr (N == 16)
    return Pack<N>((typename Pack<N>::Values)_mm512_fmadd_ps((__m512)a.v, (__m512)b.v, (__m512)c.v));
#endif
#if defined(MIMICX_FUSED)
  if constexpr (N == 8)
    return Pack<N>((typename Pack<N>::Values)_mm256_fmadd_ps((__m256)a.v, (__m256)b.v, (__m256)c.v));
  for (int i = 0; i < N; ++i) c.v[i] = __builtin_fmaf(a.v[i], b.v[i], c.v[i]);
  return c;
#else
  return a * b + c;
#endif
}

template <int N>
Pack<N> sqrt(Pack<N> a) {
#if defined(__AVX512F__)
  if constexpr (N == 16)
    return Pack<N>((typename Pack<N>::Values)_mm512_maskz_sqrt_ps(__mmask16(-1), (__m512)a.v));
#endif
#if defined(__AVX2__)
  if constexpr (N == 8) return Pack<N>((typename Pack<N>::Values)_mm256_sqrt_ps((__m256)a.v));
#endif
  for (int i = 0; i < N; ++i) a.v[i] = std::sqrt(a.v[i]);
  return a;
}

template <int N>
Pack<N> select(typename Pack<N>::Mask mask, Pack<N> a, Pack<N> b) {
  return mask ? a.v : b.v;
}
template <int N>
Pack<N> max(Pack<N> a, Pack<N> b) {
  return a.v > b.v ? a.v : b.v;
}
template <int N>
Pack<N> min(Pack<N> a, Pack<N> b) {
  return a.v < b.v ? a.v : b.v;
}

/// Whether any lane of a mask is set.
template <class Mask>
bool any(Mask mask) {
  if constexpr (sizeof(Mask) == 64) {
#if defined(__AVX512F__)
    return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
#endif
  }
  if constexpr (sizeof(Mask) == 32) {
#if defined(__AVX2__)
    return _mm256_testz_si256((__m256i)mask, (__m256i)mask) == 0;
#endif
  }
  bool result = false;
  for (std::size_t i = 0; i < sizeof(Mask) / sizeof(std::int32_t); ++i) result = result || mask[i] != 0;
  return result;
}

// The same functions for one double.
inline double fma(double a, double b, double c) {
#if defined(MIMICX_FUSED)
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
inline bool any(bool mask) { return mask; }
using std::sqrt;

/// Lane access and the scalar type of a lane, for code that fills or reads a T.
template <class T>
struct ScalarTraits;
template <>
struct ScalarTraits<double> {
  using Real = double;
  using Mask = bool;
  static constexpr int kSize = 1;
  static double get(double a, int) { return a; }
  static void set(double& a, int, double x) { a = x; }
  static bool lane(bool mask, int) { return mask; }
};
template <int N>
struct ScalarTraits<Pack<N>> {
  using Real = float;
  using Mask = typename Pack<N>::Mask;
  static constexpr int kSize = N;
  static float get(const Pack<N>& a, int lane) { return a.v[lane]; }
  static void set(Pack<N>& a, int lane, double x) { a.v[lane] = static_cast<float>(x); }
  static bool lane(const Mask& mask, int i) { return mask[i] != 0; }
};
template <class T>
using RealOf = typename ScalarTraits<T>::Real;
template <class T>
using MaskOf = typename ScalarTraits<T>::Mask;

// Calls MACRO(T) for the scalars that a build uses: for double, and for packs of its width. Processors
// without vector registers use Pack<1>. tests/physics/other_widths.cpp has the other widths.
#if defined(MIMICX_OTHER_WIDTHS) && MIMICX_LANES == 4
#define MIMICX_FOR_ALL_SCALARS(MACRO) MACRO(Pack<8>) MACRO(Pack<16>)
#elif defined(MIMICX_OTHER_WIDTHS) && MIMICX_LANES == 8
#define MIMICX_FOR_ALL_SCALARS(MACRO) MACRO(Pack<16>)
#elif defined(MIMICX_OTHER_WIDTHS)
#define MIMICX_FOR_ALL_SCALARS(MACRO) MACRO(Pack<8>)
#elif MIMICX_LANES == 4
#define MIMICX_FOR_ALL_SCALARS(MACRO) MACRO(double) MACRO(Pack<4>) MACRO(Pack<1>)
#else
#define MIMICX_FOR_ALL_SCALARS(MACRO) MACRO(double) MACRO(Pack<kLanes>)
#endif

}  // namespace mimicx::physics
