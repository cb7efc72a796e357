#pragma once
// The carried state of a saved run as JSON: {"dt_previous": 0.002, "u": [[...6], ...], "r": 41,
// "k": [[...6], ...], "k_resisting": [[...9], ...], "forces": [{"id": "2a", "lambda": [...]}]}.

#include <optional>
#include <vector>

#include "core/io/object_reader.hpp"
#include "core/model/body.hpp"
#include "core/model/carried.hpp"

namespace substep {

/// The member "carried" of a scene: its lists have one item per body or are omitted; u then
/// defaults to the bodies' velocities. A stiffness without r is a problem.
std::optional<Carried> read_carried(ObjectReader& scene, const std::vector<Body>& bodies,
                                    Problems& problems);

Json carried_json(const Carried& carried, const std::vector<Body>& bodies);

}  // namespace substep
