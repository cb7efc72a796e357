#pragma once

#include <string>
#include <string_view>

namespace substep {

/// Text for the content or a quoted attribute of HTML, SVG and other XML.
std::string xml_text(std::string_view text);

}  // namespace substep
