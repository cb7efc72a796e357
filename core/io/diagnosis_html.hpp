#pragma once

#include <string>

#include "core/lab/doctor.hpp"

namespace substep {

/// A diagnosis of a scene as a page in one file, without a script. Names are escaped.
std::string diagnosis_html(const Scene& scene, const Diagnosis& diagnosis);

/// A picture for a README: the largest step of the engine that was asked, coloured by the verdict.
std::string diagnosis_badge(const Diagnosis& diagnosis);

}  // namespace substep
