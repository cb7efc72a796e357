#pragma once

#include "core/model/range.hpp"

namespace substep {

inline constexpr double kMebibyte = 1024.0 * 1024.0;  // [bytes]

/// Resource limits of a frame. Set by the program that runs a scene, so that no file or link can
/// raise them. A simulator stops before the sub-step that would exceed them.
struct Budget {
  double memory = 512.0 * kMebibyte;  // for the factor of the direct solver [bytes]
  double work = 2e10;                 // of a frame [floating-point operations]
  double substep = 1e15;              // of the solve of one sub-step [floating-point operations]
  double contacts = 200'000.0;  // contact points at once; overlapping bodies can have billions

  friend bool operator==(const Budget&, const Budget&) = default;
};

inline constexpr Range kMemoryBudgetRange{kMebibyte, 65536.0 * kMebibyte, false, false, "bytes"};
inline constexpr Range kWorkBudgetRange{1e6, 1e15, false, false, "operations"};
inline constexpr Range kContactBudgetRange{1.0, 1e6};

}  // namespace substep
