#pragma once
// What window.substep is made of: each call takes and gives text, JSON where there is structure. A
// text that is given holds until the next call.

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#define SUBSTEP_EXPORTED EMSCRIPTEN_KEEPALIVE
#else
#define SUBSTEP_EXPORTED
#endif

extern "C" {

/// A scene of the library by its name.
SUBSTEP_EXPORTED const char* substep_open(const char* name);

/// A scene as JSON. @param from what people call it: a file's name
SUBSTEP_EXPORTED const char* substep_open_text(const char* text, const char* from);

/// Settings by name, as an object. Valid ones are applied, the others reported.
SUBSTEP_EXPORTED const char* substep_set(const char* text);

/// Takes frames at once, without waiting for the clock.
SUBSTEP_EXPORTED void substep_step(int frames);

SUBSTEP_EXPORTED void substep_substep();

/// Looks at the moment of the past that is closest to a time. @param time [s]
SUBSTEP_EXPORTED void substep_go_to(double time);

SUBSTEP_EXPORTED void substep_play(int on);

SUBSTEP_EXPORTED int substep_busy();

SUBSTEP_EXPORTED void substep_reset();

/// Shows the first screen, unless the person has left it at an earlier visit.
SUBSTEP_EXPORTED void substep_introduce();

/// @return what of it could not be read
SUBSTEP_EXPORTED const char* substep_open_link(const char* fragment);

/// Begins to read a scene's text; what was read before is forgotten.
SUBSTEP_EXPORTED void substep_read(const char* text);

/// Continues reading for one slice. @return 0 when it is done
SUBSTEP_EXPORTED int substep_read_some();

/// Opens the scene that was read: substep_open_text in parts.
SUBSTEP_EXPORTED const char* substep_open_read(const char* from);

/// substep_open_link with the scene that was read for its scene.
SUBSTEP_EXPORTED const char* substep_open_read_link(const char* fragment);

/// Starts the run that one of the two opened, or has it wait where its frames take long.
SUBSTEP_EXPORTED void substep_start_opened();

SUBSTEP_EXPORTED const char* substep_link();

SUBSTEP_EXPORTED const char* substep_command();

/// The scene that the link starts from, as a file; "" where it is a shipped one, which a link
/// names, or too large for a link.
SUBSTEP_EXPORTED const char* substep_own_scene();

/// The run as it is now, as a scene file.
SUBSTEP_EXPORTED const char* substep_saved_scene();

/// What the plots remember, as CSV: one line a frame.
SUBSTEP_EXPORTED const char* substep_history();

/// Settings with their values now, and what is allowed.
SUBSTEP_EXPORTED const char* substep_settings();

/// Something that the page found wrong with outside data.
SUBSTEP_EXPORTED void substep_trouble(const char* title, const char* place, const char* message);

SUBSTEP_EXPORTED void substep_tell(const char* text);

SUBSTEP_EXPORTED void substep_recording(int on);

SUBSTEP_EXPORTED const char* substep_hash();

/// The last frame and how the run stands.
SUBSTEP_EXPORTED const char* substep_report();

/// Where the controls of the last picture lie, and the bodies in it, in CSS pixels of the canvas.
SUBSTEP_EXPORTED const char* substep_widgets();

/// The step of the guided tour that is shown, with its numbers as the run has them; null outside
/// the tour.
SUBSTEP_EXPORTED const char* substep_tour();

/// Whether the page shows the text of the tour; the window does not then.
SUBSTEP_EXPORTED void substep_tour_in_page(int on);

/// Whether the theme is the dark one.
SUBSTEP_EXPORTED int substep_dark();

/// Names and titles of the scenes that there are.
SUBSTEP_EXPORTED const char* substep_scenes();

}  // extern "C"
