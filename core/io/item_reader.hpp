#pragma once
// Reads the lists of a scene file: bodies and joints.

#include <string>

#include "core/io/body_names.hpp"
#include "core/io/json.hpp"
#include "core/model/body.hpp"
#include "core/model/joint.hpp"
#include "core/model/problem.hpp"

namespace substep {

/// One entry of "bodies". @return the body; incomplete if problems were added
Body read_body(const Json& json, const std::string& pointer, Problems& problems);

/// One entry of "joints". @return the joint; incomplete if problems were added
Joint read_joint(const Json& json, const std::string& pointer, const BodyNames& bodies,
                 Problems& problems);

}  // namespace substep
