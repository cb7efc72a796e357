#pragma once
// "My model": what the user does to the bodies and joints of the scene. Each action is a step of
// the text's history and runs at once, from the start.

#include <functional>
#include <string>
#include <string_view>

#include "app/lab/lab.hpp"
#include "app/lab/model_edits.hpp"
#include "app/ui/desk.hpp"

namespace substep::ui {

/// The panel, in place of all others, as that of the text.
void open_model(Desk& desk);

/// Runs a new scene with a floor, paused.
void new_scene(Lab& lab, Desk& desk);

/// A change of a text and of the scene that it describes.
using ModelChange = std::function<std::string(const std::string& text, const Scene& scene)>;
/// What is selected stays selected. @return problems: then nothing changes
Problems change_model(Lab& lab, Desk& desk, const ModelChange& change);
/// The same; problems are shown as a notice.
void change_or_tell(Lab& lab, Desk& desk, const ModelChange& change);

/// Whether a new body of this kind is joined to the selected one, or, a link, to the world.
bool joins(const Lab& lab, const Desk& desk, BodyPart part);
/// Adds a body and selects it.
void add_to_model(Lab& lab, Desk& desk, BodyPart part);
void copy_selected(Lab& lab, Desk& desk);
/// Deletes the selected body with its joints.
void delete_selected(Lab& lab, Desk& desk);
/// Joins the selected body to another one, or to the world.
void connect_selected(Lab& lab, Desk& desk, int other);
void step_model(Lab& lab, Desk& desk, bool forward);

/// Actions by name, with semicolons between them: "new", "link", "ball", "box", "copy", "delete",
/// "moves", "static", "undo", "redo", "connect:NAME", or "FIELD:VALUE" of the selected body, with
/// commas between three numbers; at most 100. @return error message, or ""
std::string edit_model(Lab& lab, Desk& desk, std::string_view actions);

}  // namespace substep::ui
