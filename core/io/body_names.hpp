#pragma once
// Lookup of bodies by name.

#include <map>
#include <optional>
#include <string>

#include "core/io/object_reader.hpp"
#include "core/model/scene.hpp"

namespace substep {

inline constexpr std::string_view kWorldName = "world";  ///< as a joint's b; no body has this name

class BodyNames {
 public:
  /// Bodies by index; a duplicate or reserved name is a problem of "/bodies/i/name".
  BodyNames(const std::vector<Body>& bodies, Problems& problems);

  /// The body named by a member, or nothing and a problem.
  std::optional<int> read(ObjectReader& in, std::string_view key, Presence presence) const;

  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }

 private:
  const std::vector<Body>& bodies_;
  std::map<std::string, int, std::less<>> index_;
};

}  // namespace substep
