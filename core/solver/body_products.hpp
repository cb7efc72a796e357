#pragma once
// Products of the 6-vectors of a body: linear part first, then angular.

#include "core/solver/system.hpp"

namespace substep {

/// Pointer to J of one row on one side. @param of_pin storage for a point row, whose J is implicit
inline const double* gradient(const Block& block, int row, bool of_a, Vec6& of_pin) {
  if (!block.has_point_rows) return of_a ? block.J_a[row] : block.J_b[row];
  of_pin = gradient(block, row, of_a);
  return of_pin.data();
}

/// Scalar copies: vector loads would stall on recent scalar stores.
inline void copy6(const double* from, double* to) {
  for (int j = 0; j < 6; ++j) to[j] = from[j];
}

inline double dot6(const double* a, const double* b) {
  return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// Mt^-1 f.
inline void weigh(const InverseMass& mass, const double* f, double* out) {
  for (int i = 0; i < 3; ++i) {
    out[i] = mass.linear * f[i];
    out[3 + i] = mass.angular(i, 0) * f[3] + mass.angular(i, 1) * f[4] + mass.angular(i, 2) * f[5];
  }
}

}  // namespace substep
