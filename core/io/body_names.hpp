#pragma once
// Bodies by name, for all that refers to them.

#include <map>
#include <optional>
#include <string>

#include "core/io/object_reader.hpp"
#include "core/model/scene.hpp"

namespace substep {

inline constexpr std::string_view kWorldName = "world";  ///< as a joint's b; no body has this name

class BodyNames {
 public:
  /// Bodies by their place; a name that stands twice or is reserved is a problem of
  /// "/bodies/i/name".
  BodyNames(const std::vector<Body>& bodies, Problems& problems);

  /// The body that a member names, or nothing and a problem.
  std::optional<int> read(ObjectReader& in, std::string_view key, Presence presence) const;

  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }

 private:
  const std::vector<Body>& bodies_;
  std::map<std::string, int, std::less<>> index_;
};

}  // namespace substep
