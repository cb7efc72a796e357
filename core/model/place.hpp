#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/model/problem.hpp"

namespace substep {

/// A location in checked data, such as /joints/3/b. The pointer text is built only for problems:
/// building it for every value would dominate the cost of checking a scene.
///
/// Refers to its parent location: do not keep one made from a temporary.
class DataPlace {
 public:
  /// @param pointer JSON pointer, "" for the whole document
  template <std::convertible_to<std::string_view> Text>
  DataPlace(const Text& pointer) : key_(pointer) {}

  [[nodiscard]] DataPlace at(std::string_view key) const { return {this, key, 0}; }
  [[nodiscard]] DataPlace at(std::size_t index) const { return {this, {}, index}; }

  [[nodiscard]] std::string pointer() const {
    if (parent_ == nullptr) return std::string(key_);
    if (key_.empty()) return pointer_to(parent_->pointer(), index_);
    return pointer_to(parent_->pointer(), key_);
  }

 private:
  DataPlace(const DataPlace* parent, std::string_view key, std::size_t index)
      : parent_(parent), key_(key), index_(index) {}

  const DataPlace* parent_ = nullptr;
  std::string_view key_;  // empty in a list
  std::size_t index_ = 0;
};

}  // namespace substep
