// Replaces the bundled page if Node.js or the chart library was not available at build time.
#include "app/report/page.hpp"

namespace substep::report {

const std::string_view kHead;
const std::string_view kTail;

}  // namespace substep::report
