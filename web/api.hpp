#pragma once
// The exports behind window.substep: arguments and results are text, JSON if structured. A returned
// text is valid until the next call.

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#define SUBSTEP_EXPORTED EMSCRIPTEN_KEEPALIVE
#else
#define SUBSTEP_EXPORTED
#endif

extern "C" {

/// Opens a scene of the library by name.
SUBSTEP_EXPORTED const char* substep_open(const char* name);

/// Opens a scene given as JSON. @param from its name in messages: a file name
SUBSTEP_EXPORTED const char* substep_open_text(const char* text, const char* from);

/// Sets settings by name, given as an object. Applies valid ones and reports the others.
SUBSTEP_EXPORTED const char* substep_set(const char* text);

/// Takes frames at once, independent of the clock.
SUBSTEP_EXPORTED void substep_step(int frames);

SUBSTEP_EXPORTED void substep_substep();

/// Shows the past moment closest to a time. @param time [s]
SUBSTEP_EXPORTED void substep_go_to(double time);

SUBSTEP_EXPORTED void substep_play(int on);

SUBSTEP_EXPORTED int substep_busy();

SUBSTEP_EXPORTED void substep_reset();

/// Shows the first screen, unless the user dismissed it on an earlier visit.
SUBSTEP_EXPORTED void substep_introduce();

/// @return the parts that could not be read
SUBSTEP_EXPORTED const char* substep_open_link(const char* fragment);

/// Begins to parse a scene's text; discards an earlier one.
SUBSTEP_EXPORTED void substep_read(const char* text);

/// Continues parsing for one slice. @return 0 when done
SUBSTEP_EXPORTED int substep_read_some();

/// Opens the parsed scene: substep_open_text in steps.
SUBSTEP_EXPORTED const char* substep_open_read(const char* from);

/// substep_open_link with the parsed scene.
SUBSTEP_EXPORTED const char* substep_open_read_link(const char* fragment);

/// Starts the run that either of the two opened, or waits for confirmation if its frames are slow.
SUBSTEP_EXPORTED void substep_start_opened();

SUBSTEP_EXPORTED const char* substep_link();

SUBSTEP_EXPORTED const char* substep_command();

/// The scene that the link starts from, as a file; "" if it is a shipped one, which the link names,
/// or too large for a link.
SUBSTEP_EXPORTED const char* substep_own_scene();

/// The current state of the run as a scene file.
SUBSTEP_EXPORTED const char* substep_saved_scene();

/// The scene as text, as the editor has it: {text, runs, problems: [{line, column, pointer,
/// message}]}; without the editor that of the run.
SUBSTEP_EXPORTED const char* substep_scene_text();

/// Replaces it, as an edit that can be undone, and runs it if it is valid. @return the same
SUBSTEP_EXPORTED const char* substep_edit_text(const char* text);

/// The samples of the plots as CSV, one line per frame.
SUBSTEP_EXPORTED const char* substep_history();

/// Settings with their current and allowed values.
SUBSTEP_EXPORTED const char* substep_settings();

/// Shows a problem with external data that the page found.
SUBSTEP_EXPORTED void substep_trouble(const char* title, const char* place, const char* message);

SUBSTEP_EXPORTED void substep_tell(const char* text);

SUBSTEP_EXPORTED void substep_recording(int on);

SUBSTEP_EXPORTED const char* substep_hash();

/// The last frame and the verdict.
SUBSTEP_EXPORTED const char* substep_report();

/// Rectangles of the last picture's controls, and the places of its bodies, in CSS pixels of the
/// canvas.
SUBSTEP_EXPORTED const char* substep_widgets();

/// The current step of the guided tour with its current numbers; null outside the tour.
SUBSTEP_EXPORTED const char* substep_tour();

/// Whether the page shows the text of the tour instead of the window.
SUBSTEP_EXPORTED void substep_tour_in_page(int on);

/// Whether the theme is dark.
SUBSTEP_EXPORTED int substep_dark();

/// Names and titles of all scenes.
SUBSTEP_EXPORTED const char* substep_scenes();

}  // extern "C"
