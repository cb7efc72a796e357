#pragma once
// What the window consists of. Each function fills the current Dear ImGui window.

#include <imgui.h>

#include <string>
#include <vector>

#include "app/app.hpp"
#include "app/lab/criterion.hpp"

namespace substep::ui {

/// All of the window for this frame; sets app.view_rect.
void draw_window(App& app);
/// What is drawn and written over the picture, once it is known where things are in it.
void draw_over_picture(App& app);

/// The picture under the pointer: turns, moves and zooms it, selects and pulls bodies.
void view_input(App& app);
/// A ball from beside the eye at what the pointer is on.
void throw_ball(App& app);

void controls(App& app);
/// Mode and solver with their parameters: the controls that any run has.
/// @param more whether the finer points are unfolded
void method_controls(const Look& look, const Scene& scene, Settings& settings, bool& more);
/// @param height that the plots share; 0 takes what they need at least
void plots(App& app, float height);
/// The run so far as a CSV file, of the channels of the plots that are shown.
void save_table(App& app);
/// What files of this run are called, without an ending.
std::string file_stem(const App& app);
/// Who sets N, in two lines and a picture.
void why_summary(App& app);
/// All of it: the law with its numbers, and every body's part.
void why(App& app);
/// The two terms of the criterion, and which of them sets N.
void criterion_terms(App& app, const Criterion& criterion);
/// What runs beside this run.
void compare(App& app);
/// The effects of the scene, to be switched off while it runs, with what each costs.
void effect_switches(App& app);
/// Where the time of a frame goes: stages, effects, the criterion.
void effect_costs(App& app);
/// What accuracy costs: all methods over this scene.
void accuracy(App& app);
/// What to set, in the same panel: the cheapest within an error or the most exact within a cost,
/// with the reason, a button that runs it, and a search for the paper's alpha.
void advice(App& app);
/// How far the search for the paper's alpha is, while it goes on, and a button that ends it.
void search_bar(App& app);
/// Its picture over the view, where that was asked for.
void accuracy_card(App& app);
/// Where runs are seen: all of the view, or equal parts of it side by side or one over the other,
/// whichever shows the scene larger.
std::vector<ViewRect> view_panes(const App& app);
/// The part of the window that a pane's picture covers.
Part part_of_window(const App& app, std::size_t pane);
/// Who is who in the picture; nothing where nothing is compared.
void compare_legend(const App& app);
/// "holds", or when it failed.
std::string verdict_note(const Verdict& verdict);
/// The guided tour's card, or the button that opens it.
void tour(App& app);
/// What this run is called beside others.
std::string run_title(const App& app);
/// @param brief without the list of stages
void timing(App& app, bool brief);
/// @param phone two rows, larger targets
void transport(App& app, bool phone);

/// The run's past, to be looked at.
void scrubber(App& app, ImVec2 at, float width, float height);
/// The button with the menu of links, files and pictures.
void share_menu(App& app, float size);
void copy_link(App& app);
void copy_command(App& app);
/// A picture of the whole window, when this frame has been drawn.
void capture_window(App& app);
/// Begins the tour, or goes to its next step; after the last one it ends.
void go_on_with_tour(App& app);
/// The folder that a scene file is chosen from, while one is.
void file_card(App& app);

/// Over the picture: what runs, N, the scale of the tint, masses, and what went wrong.
void caption(App& app, bool phone);
void body_labels(App& app);
void annotations(App& app);
void selection_card(App& app, bool phone);
void tint_scale(App& app);
void failure_card(App& app);
void trouble_card(App& app);
void help_card(App& app);

/// Heights that the right panel's fixed parts need.
float why_summary_height();
float timing_height(const App& app, bool brief);

}  // namespace substep::ui
