#pragma once

#include <string>

#include "core/import/import_report.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// A scene as a model of MuJoCo, and what it says otherwise or not at all, by joint and body.
/// Nothing is dropped in silence.
struct ExportedModel {
  std::string text;             // MJCF, Z up
  ImportNotes approximated;     // written, but not as the scene has it
  ImportNotes left_out;         // not written
  bool has_velocities = false;  // they are in its keyframe "start"
};

/// Writes a scene that can run. Its bodies' frames are those of the model; angles and travels are 0
/// at the start. Numbers are without loss. Of a scene that a Simulator refuses, the text is empty
/// and the reason is in `left_out`.
ExportedModel export_mjcf(const Scene& scene);

}  // namespace substep
