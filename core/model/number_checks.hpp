#pragma once
// Numbers against their ranges, in the words of the scene reader.

#include <cstddef>

#include "core/math/types.hpp"
#include "core/model/place.hpp"
#include "core/model/problem.hpp"
#include "core/model/range.hpp"

namespace substep {

/// Notes a number outside its range; NaN is outside of every range.
inline void check_number(double value, const Range& range, const DataPlace& place,
                         Problems& problems) {
  if (range.contains(value)) return;
  problems.push_back(
      {place.pointer(), "must be " + range.violated_by(value) + ", not " + number_text(value)});
}

/// Each of the numbers of a vector.
template <class Vector>
void check_numbers(const Vector& values, const Range& range, const DataPlace& place,
                   Problems& problems) {
  for (int i = 0; i < values.size(); ++i) {
    check_number(values[i], range, place.at(static_cast<std::size_t>(i)), problems);
  }
}

}  // namespace substep
