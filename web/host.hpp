#pragma once

#include "app/app.hpp"

namespace substep::web {

/// Services that the page provides to the application: functions of Module.host, see web/host.cpp.
Host page_host();
/// Dear ImGui's copy and paste through the page.
void use_page_clipboard();

}  // namespace substep::web
