#pragma once

#include <optional>

#include "core/io/json.hpp"
#include "core/lab/doctor.hpp"
#include "core/model/problem.hpp"

namespace substep {

/// A diagnosis of a scene: `substep doctor --json`, and the answer of the page. Times are in s; a
/// limit that does not exist is null.
Json diagnosis_json(const Scene& scene, const Diagnosis& diagnosis);

/// A question as an object of {engine, step, held, seconds, runs}, all optional: the flags of
/// `substep doctor`. Nothing if there is a problem.
std::optional<DoctorQuestion> read_question(const Json& json, Problems& problems);

}  // namespace substep
