#include "core/io/body_names.hpp"

#include "core/model/scene_limits.hpp"

namespace substep {

BodyNames::BodyNames(const std::vector<Body>& bodies, Problems& problems) : bodies_(bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string& name = bodies[i].name;
    const std::string pointer = pointer_to(pointer_to("/bodies", i), "name");
    if (name.empty()) continue;  // reported when it was read
    if (name == kWorldName) {
      problems.push_back({pointer, "must not be \"world\", the name of the fixed world"});
      continue;
    }
    const auto [first, is_new] = index_.emplace(name, static_cast<int>(i));
    if (!is_new) {
      problems.push_back({pointer, value_text(name) + " is already the name of /bodies/" +
                                       std::to_string(first->second)});
    }
  }
}

std::optional<int> BodyNames::read(ObjectReader& in, std::string_view key,
                                   Presence presence) const {
  std::string name;
  if (!in.text(key, kMaxNameSize, name, presence)) return std::nullopt;
  if (name == kWorldName) return kWorld;
  if (const auto found = index_.find(name); found != index_.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& entry : index_) names.push_back(entry.first);
  in.problem(key, "no body is called " + value_text(name) + in.guess(name, names));
  return std::nullopt;
}

}  // namespace substep
