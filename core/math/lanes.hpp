#pragma once
// Per-body formulas, written once and evaluated for one body or for two in SIMD lanes. Sums use the
// same order as Eigen.

#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>

#include "core/math/pair.hpp"

namespace substep {

inline double root(double x) { return std::sqrt(x); }
inline Pair root(const Pair& x) { return Pair{std::sqrt(x[0]), std::sqrt(x[1])}; }

/// A vector of one body (T = double), or of two (T = Pair).
template <class T>
struct Lanes3 {
  T x, y, z;
  friend Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Lanes3 operator*(const T& f, const Lanes3& a) { return {f * a.x, f * a.y, f * a.z}; }
};
template <class T>
[[gnu::always_inline]] inline T dot(const Lanes3<T>& a, const Lanes3<T>& b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}
template <class T>
[[gnu::always_inline]] inline Lanes3<T> cross(const Lanes3<T>& a, const Lanes3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Memory of one body, or the same members of two. @tparam Number double or const double
template <class T, class Number>
struct Place;
template <class Number>
struct Place<double, Number> {
  Number* of;
  double operator[](int k) const { return of[k]; }
  void set(int k, double value) const { of[k] = value; }
};
template <class Number>
struct Place<Pair, Number> {
  Number* of_first;
  Number* of_second;
  Pair operator[](int k) const { return Pair{of_first[k], of_second[k]}; }
  void set(int k, const Pair& value) const {
    of_first[k] = value[0];
    of_second[k] = value[1];
  }
};

/// A vector that starts at the k-th number.
template <class T, class Number>
[[gnu::always_inline]] inline Lanes3<T> vector_at(const Place<T, Number>& place, int k = 0) {
  return {place[k], place[k + 1], place[k + 2]};
}
template <class T>
[[gnu::always_inline]] inline void set_vector(const Place<T, double>& place, int k,
                                              const Lanes3<T>& value) {
  place.set(k, value.x);
  place.set(k + 1, value.y);
  place.set(k + 2, value.z);
}

/// R of a unit quaternion, column by column. @param q x, y, z, w
template <class T>
[[gnu::always_inline]] inline void rotation_matrix(const Place<T, const double>& q,
                                                   const Place<T, double>& R) {
  const Lanes3<T> v = vector_at(q);
  const T w = q[3];
  const T tx = 2.0 * v.x;
  const T ty = 2.0 * v.y;
  const T tz = 2.0 * v.z;
  const T xx = tx * v.x;
  const T xy = ty * v.x;
  const T xz = tz * v.x;
  const T yy = ty * v.y;
  const T yz = tz * v.y;
  const T zz = tz * v.z;
  set_vector(R, 0, Lanes3<T>{1.0 - (yy + zz), xy + tz * w, xz - ty * w});
  set_vector(R, 3, Lanes3<T>{xy - tz * w, 1.0 - (xx + zz), yz + tx * w});
  set_vector(R, 6, Lanes3<T>{xz + ty * w, yz - tx * w, 1.0 - (xx + yy)});
}

/// One item, by index.
struct One {
  using T = double;
  static constexpr int count = 1;
  int first;
  /// @param address function from an index to the numbers of that item
  auto at(const auto& address) const {
    return Place<T, std::remove_pointer_t<decltype(address(first))>>{address(first)};
  }
};
/// Two items in SIMD lanes.
struct Two {
  using T = Pair;
  static constexpr int count = 2;
  int first;
  int second;
  auto at(const auto& address) const {
    return Place<T, std::remove_pointer_t<decltype(address(first))>>{address(first),
                                                                     address(second)};
  }
};

/// Calls with all items, two at a time if `match` is true for the pair.
void in_pairs(std::span<const int> all, const auto& match, const auto& call) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k + 1 < all.size() && match(all[k], all[k + 1])) {
      call(Two{all[k], all[k + 1]});
      ++k;
    } else {
      call(One{all[k]});
    }
  }
}
void in_pairs(std::span<const int> all, const auto& call) {
  in_pairs(
      all, [](int, int) { return true; }, call);
}

}  // namespace substep
