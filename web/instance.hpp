#pragma once
// The one application of this module: made by substep_start, used by everything that is exported.

#include <memory>

#include "app/app.hpp"
#include "app/ui/context.hpp"
#include "core/io/scene_reader.hpp"

namespace substep::web {

struct Instance {
  ui::Context context;
  std::unique_ptr<App> app;
  std::unique_ptr<SceneReading> reading;  // of the scene that is being read, or was read
  bool pinching = false;                  // two fingers are or were on the picture
};

/// Null before substep_start.
extern std::unique_ptr<Instance> instance;

}  // namespace substep::web
