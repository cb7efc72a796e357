#pragma once

#include <string_view>

namespace substep::report {

/// The report's page around its data, which stand between the two as JSON. Empty where the program
/// was built without Node.js and the chart library.
extern const std::string_view kHead;
extern const std::string_view kTail;

}  // namespace substep::report
