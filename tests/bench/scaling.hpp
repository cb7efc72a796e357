#pragma once
// Growing scenes: the cost of a sub-step as a function of the number of links, layers and contacts.

#include <memory>
#include <string>
#include <vector>

#include "core/model/scene.hpp"

namespace substep::bench {

struct Growing {
  std::string name;  // "rope/100"
  std::shared_ptr<const Scene> scene;
  SolverKind solver = SolverKind::kBpp;
};

/// Ropes of 25 to 1,600 links, stacks of 2 to 40 layers, walls up to some 2,000 contacts, pyramids
/// of 120, 465 and 1,830 boxes.
std::vector<Growing> growing_scenes();

}  // namespace substep::bench
