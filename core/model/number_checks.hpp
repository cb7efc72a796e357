#pragma once
// Numbers against their ranges, in the words of the scene reader.

#include <string>
#include <string_view>

#include "core/math/types.hpp"
#include "core/model/problem.hpp"
#include "core/model/range.hpp"

namespace substep {

/// Notes a number outside its range; NaN is outside of every range.
inline void check_number(double value, const Range& range, const std::string& pointer,
                         Problems& problems) {
  if (range.contains(value)) return;
  problems.push_back(
      {pointer, "must be " + range.violated_by(value) + ", not " + number_text(value)});
}

/// Each of the numbers of a vector.
template <class Vector>
void check_numbers(const Vector& values, const Range& range, const std::string& pointer,
                   Problems& problems) {
  for (int i = 0; i < values.size(); ++i) {
    check_number(values[i], range, pointer_to(pointer, static_cast<std::size_t>(i)), problems);
  }
}

}  // namespace substep
