#pragma once
// The single application of this module: created by substep_start, used by all exports.

#include <memory>
#include <string>

#include "app/app.hpp"
#include "app/ui/context.hpp"
#include "core/io/scene_reader.hpp"

namespace substep::web {

struct Instance {
  ui::Context context;
  std::unique_ptr<App> app;
  std::unique_ptr<SceneReading> reading;  // of the scene being parsed, or parsed last
  std::string model;                      // the text instead, if it is imported
  bool pinching = false;                  // a two-finger gesture on the picture is or was active
};

/// Null before substep_start.
extern std::unique_ptr<Instance> instance;

}  // namespace substep::web
