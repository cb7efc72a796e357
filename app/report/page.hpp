#pragma once

#include <string_view>

namespace substep::report {

/// The report's page before and after its JSON data. Empty if the program was built without Node.js
/// and the chart library.
extern const std::string_view kHead;
extern const std::string_view kTail;

}  // namespace substep::report
