#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/model/problem.hpp"

namespace substep {

/// A place in data that is checked, such as /joints/3/b. It is spelt out only where something is
/// wrong: a simulator checks all of its scene, and pointers would take most of that time.
///
/// It refers to the place that it is in: keep none that was made from a temporary.
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
