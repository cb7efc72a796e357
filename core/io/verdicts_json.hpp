#pragma once
// The verdict table of a scene: its rules as JSON, {"solver": "pgs", "mode": "const", "n": 4,
// "verdict": "fails", "before": 2, "why": "..."}.

#include "core/io/object_reader.hpp"
#include "core/model/expectation.hpp"

namespace substep {

/// The member "verdicts" of a scene; without it the table is empty. Contradictions are problems: an
/// n without mode const, a failure time without kFails, `depends` without a reason.
Expectations read_verdicts(ObjectReader& scene, Problems& problems);

Json verdicts_json(const Expectations& rules);

}  // namespace substep
