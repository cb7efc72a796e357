#pragma once
// Names of a model as those of a scene.

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace substep {

/// The text without characters that a scene refuses, of at most `most` bytes.
std::string text_within(std::string_view text, std::size_t most);

/// An identifier of a scene: a-z, 0-9, _ and -; others become _.
std::string identifier_of(std::string_view name);

/// Hands out names that differ. A name that was given before gets a number.
class UniqueNames {
 public:
  /// @param reserved a name that is not given; "" for none
  explicit UniqueNames(std::string reserved = "");
  std::string unique(const std::string& wanted);

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> next_;  // number to try for a name
};

}  // namespace substep
