#pragma once
// What the window consists of. Each function fills the current Dear ImGui window, and takes what it
// shows and what it may change.

#include <imgui.h>

#include <string>
#include <vector>

#include "app/lab/criterion.hpp"
#include "app/lab/lab.hpp"
#include "app/shell/file_browser.hpp"
#include "app/text/tour_words.hpp"
#include "app/ui/desk.hpp"
#include "app/ui/look.hpp"
#include "app/ui/viewport.hpp"

namespace substep {

struct App;

namespace ui {

/// All of the window for this frame; sets app.view_rect.
void draw_window(App& app);
/// What is drawn and written over the picture, once it is known where things are in it.
void draw_over_picture(App& app);
/// The first screen; sets app.view_rect.
void introduction(App& app);
/// Where its two runs are drawn: the session, and the one beside it.
std::vector<ViewRect> introduction_panes(const Look& look, const Lab& lab);
/// The part of the window that one of the two pictures covers.
Part introduction_part(const Viewport& viewport, std::size_t pane);

/// The picture under the pointer: turns, moves and zooms it, selects and pulls bodies.
void view_input(Lab& lab, Desk& desk, Viewport& viewport);
/// A ball from beside the eye at what the pointer is on.
void throw_ball(Lab& lab, const Viewport& viewport);

void controls(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
/// The menu of scenes.
void scene_picker(const Look& look, Lab& lab, Desk& desk, const char* tip);
/// What the level Explore has of them, below the scene.
void explore_controls(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
/// Mode and solver with their parameters: the controls that any run has.
/// @param more whether the finer points are unfolded
void method_controls(const Look& look, const Scene& scene, Settings& settings, bool& more);
/// @param height that the plots share; 0 takes what they need at least
void plots(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport, float height);
/// The run so far as a CSV file, of the channels of the plots that are shown.
void save_table(const Lab& lab, Desk& desk);
/// What files of this run are called, without an ending.
std::string file_stem(const Session& session);
/// Who sets N, in two lines and a picture.
void why_summary(const Look& look, const Session& session, Desk& desk);
/// All of it: the law with its numbers, and every body's part.
void why(const Look& look, const Session& session, Desk& desk);
/// The two terms of the criterion, and which of them sets N.
void criterion_terms(const Look& look, const Session& session, const Criterion& criterion);
/// What runs beside this run.
void compare(const Look& look, Lab& lab, Desk& desk);
/// A menu of methods, each of which may be added to what runs beside it.
void compare_menu(const Look& look, const Session& session, Compare& compare, const char* name,
                  float width);
/// The effects of the scene by name, to be switched off while it runs.
void effect_switches(const Look& look, Session& session);
/// Their rows, and what each costs.
void effect_table(const Look& look, Lab& lab);
/// Where the time of a frame goes: stages, effects, the criterion.
void effect_costs(const Look& look, Lab& lab);
/// What accuracy costs: all methods over this scene.
void accuracy(const Look& look, Lab& lab, Desk& desk);
/// What to set, in the same panel: the cheapest within an error or the most exact within a cost,
/// with the reason, a button that runs it, and a search for the paper's alpha.
void advice(const Look& look, Lab& lab);
/// Progress of the search for the paper's alpha, and a button that ends it.
void search_bar(const Look& look, Accuracy& accuracy);
/// Its picture over the view, while that is chosen.
void accuracy_card(const Look& look, Lab& lab, const Desk& desk, const Viewport& viewport);
/// Where runs are drawn: all of the view, or equal parts of it side by side or one over the other,
/// whichever shows the scene larger.
std::vector<ViewRect> view_panes(const Compare& compare, const Desk& desk,
                                 const Viewport& viewport);
/// The part of the window that a pane's picture covers.
Part part_of_window(const Viewport& viewport, std::size_t pane);
/// The legend of the compared runs; nothing without a comparison.
void compare_legend(const Look& look, const Session& session, const Compare& compare,
                    const Viewport& viewport);
/// The guided tour's card, or the button that opens it.
/// @param words of the step that is shown, null outside the tour
void tour(const Look& look, Desk& desk, const Viewport& viewport, const TourWords* words);
inline constexpr const char* kTourTip = "The paper's story in seven steps";
/// What this run is called beside others.
std::string run_title(const Session& session, const Compare& compare);
/// @param brief without the list of stages
void timing(const Look& look, const Session& session, bool brief);
/// @param phone two rows, larger targets
void transport(App& app, bool phone);

/// The run's past, to be looked at.
void scrubber(const Look& look, Session& session, ImVec2 at, float width, float height);
/// The button with the menu of links, files and pictures.
void share_menu(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport, float size);
void copy_link(const Lab& lab);
void copy_command(Lab& lab);
/// A picture of the whole window, when this frame has been drawn.
void capture_window(const Session& session, Desk& desk);
/// Begins the tour, or goes to its next step; after the last one it ends.
void go_on_with_tour(Desk& desk);
/// The folder that a scene file is chosen from, while one is.
void file_card(const Look& look, Lab& lab, const Viewport& viewport, FileBrowser& browser);

/// Over the picture: what runs, N, the scale of the tint, masses, and what went wrong.
void caption(const Look& look, const Session& session, const Viewport& viewport, bool phone);
void body_labels(const Look& look, const Session& session, const Desk& desk,
                 const Viewport& viewport);
void annotations(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport);
void selection_card(const Look& look, const Session& session, Desk& desk, const Viewport& viewport,
                    bool phone);
void tint_scale(const Look& look, const Session& session, const Compare& compare, const Desk& desk,
                const Viewport& viewport);
void failure_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
void trouble_card(const Look& look, Lab& lab, const Viewport& viewport);
/// Why a run was not started, with a button that starts it.
void heavy_card(const Look& look, Lab& lab, const Viewport& viewport);
/// How far a long frame is, with a button that leaves it.
void long_frame_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
void help_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);

/// Heights that the right panel's fixed parts need.
float why_summary_height();
float timing_height(const Look& look, const Session& session, bool brief);

}  // namespace ui
}  // namespace substep
