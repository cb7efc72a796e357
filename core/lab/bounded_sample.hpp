#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/random.hpp"

namespace substep {

/// A bounded number of the values of a run of any length: all of them up to kMost, then a random
/// sample of that many, in which every value is equally likely (Vitter's algorithm R). The sample
/// depends on the number of values only, so it is the same on every machine. The rank of a quantile
/// is then uncertain by about 0.4 %.
class BoundedSample {
 public:
  static constexpr std::size_t kMost = 16384;

  void add(double value) {
    ++seen_;
    if (values_.size() < kMost) {
      values_.push_back(value);
      return;
    }
    const double share = 0.5 * (random_.next() + 1.0);  // [0, 1)
    const auto at = static_cast<std::int64_t>(share * static_cast<double>(seen_));
    if (at < static_cast<std::int64_t>(kMost)) values_[static_cast<std::size_t>(at)] = value;
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// The upper one if between two values; 0 without values. @param share 0 to 1
  [[nodiscard]] double quantile(double share) const {
    if (values_.empty()) return 0.0;
    std::vector<double> sorted = values_;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
    const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(at, sorted.size() - 1));
    std::nth_element(sorted.begin(), nth, sorted.end());
    return *nth;
  }

 private:
  std::vector<double> values_;
  std::int64_t seen_ = 0;
  Random random_{1};
};

}  // namespace substep
