#pragma once
// Range checks of numbers, with the messages of the scene reader.

#include <cstddef>
#include <optional>

#include "core/math/types.hpp"
#include "core/model/place.hpp"
#include "core/model/problem.hpp"
#include "core/model/range.hpp"

namespace substep {

/// Adds a problem if a number is outside its range; NaN is outside every range.
inline void check_number(double value, const Range& range, const DataPlace& place,
                         Problems& problems) {
  if (range.contains(value)) return;
  problems.push_back({place.pointer(), must_be(range.violated_by(value), number_text(value))});
}

/// The same for a number that may be missing.
inline void check_number(const std::optional<double>& value, const Range& range,
                         const DataPlace& place, Problems& problems) {
  if (value) check_number(*value, range, place, problems);
}

/// The same for each component of a vector.
template <class Vector>
void check_numbers(const Vector& values, const Range& range, const DataPlace& place,
                   Problems& problems) {
  for (int i = 0; i < values.size(); ++i) {
    check_number(values[i], range, place.at(static_cast<std::size_t>(i)), problems);
  }
}

}  // namespace substep
