#pragma once
// The parts of the window. Each function fills the current Dear ImGui window; its parameters are
// the data that it shows and may change.

#include <imgui.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/lab.hpp"
#include "app/shell/file_browser.hpp"
#include "app/text/tour_words.hpp"
#include "app/ui/desk.hpp"
#include "app/ui/look.hpp"
#include "app/ui/viewport.hpp"

namespace substep {

struct App;

namespace ui {

/// Draws the whole window for this frame; sets app.view_rect.
void draw_window(App& app);
/// Draws the overlays of the picture; call after the picture's projection is known.
void draw_over_picture(App& app);
/// The first screen; sets app.view_rect.
void introduction(App& app);
/// The rectangles of its two runs: the session and the one beside it.
std::vector<ViewRect> introduction_panes(const Look& look, const Lab& lab);
/// The part of the window covered by one of the two pictures.
Part introduction_part(const Viewport& viewport, std::size_t pane);

/// Handles the pointer over the picture: orbits, pans, zooms, selects and pulls bodies.
void view_input(Lab& lab, Desk& desk, Viewport& viewport);
/// Throws a ball from beside the eye at the point under the pointer.
void throw_ball(Lab& lab, const Viewport& viewport);

void controls(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
/// The scene menu.
void scene_picker(const Look& look, Lab& lab, Desk& desk, std::string_view tip);
/// The controls of the Explore level, below the scene.
void explore_controls(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
/// Mode and solver with their parameters: the controls common to all runs.
/// @param more whether the advanced settings are unfolded
void method_controls(const Look& look, const Scene& scene, Settings& settings, bool& more);
/// @param height shared by the plots; 0: their minimum
void plots(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport, float height);
/// The shown plots alone, for a paper.
void plots_figure(const Look& look, Lab& lab, Desk& desk);
/// Saves the run so far as a CSV file, with the channels of the plots shown.
void save_table(const Lab& lab, Desk& desk);
/// Summary of what sets N, in two lines and a picture.
void why_summary(const Look& look, const Session& session, Desk& desk);
/// The full explanation: the law with its values, and each body's share.
void why(const Look& look, const Session& session, Desk& desk);
/// The runs compared with this run.
void compare(const Look& look, Lab& lab, Desk& desk);
/// A menu of methods to add to the comparison.
void compare_menu(const Look& look, const Session& session, Compare& compare, const char* name,
                  float width);
/// Switches for the scene's effects, live.
void effect_switches(const Look& look, Session& session);
/// The effects as rows, with the cost of each.
void effect_table(const Look& look, Lab& lab);
/// The time of a frame by stage, effect and criterion.
void effect_costs(const Look& look, Lab& lab);
/// The cost of accuracy: all methods on this scene.
void accuracy(const Look& look, Lab& lab, Desk& desk);
/// Its picture alone, for a paper.
void accuracy_figure(const Look& look, Lab& lab);
/// "Find N": sub-steps and error along alpha, and the cheapest method within an error.
void find_n(const Look& look, Lab& lab);
/// Its plots. @param width logical pixels @return the run whose column was pressed, or null
const Result* find_n_chart(const Look& look, const FindN& find, float width);
/// A button that opens the panel and starts the search.
void find_n_button(const Look& look, Lab& lab, Desk& desk);
/// The scene as text, with its problems.
void scene_text_panel(const Look& look, Lab& lab, Desk& desk, float height);
/// "My model": bodies, joints and the scene, changed by hand.
void model_panel(const Look& look, Lab& lab, Desk& desk);
inline constexpr const char* kEditByHand = "Edit by hand";
/// The head of both editors, with a choice between them.
void editor_heading(const Look& look, Desk& desk);
/// Opens that of the text.
void open_scene_text(Desk& desk);
void close_scene_text(Desk& desk);
inline constexpr const char* kEditText = "Edit as text";
/// The recommendation in the same panel: the cheapest within an error or the most accurate within a
/// cost, with the reason, a button to run it, and a search for the paper's alpha.
void advice(const Look& look, Lab& lab);
/// Progress of the search for the paper's alpha, with a cancel button.
void search_bar(const Look& look, Accuracy& accuracy);
/// The accuracy picture over the view, while that is selected.
void accuracy_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
/// Error against cost on logarithmic axes: a curve per method, the Pareto front, the failed runs on
/// a separate rail. @param current settings of the run, ringed @return the result that was clicked
std::optional<std::size_t> accuracy_picture(const Look& look, const Accuracy& accuracy,
                                            const Settings& current, ImVec2 size);
/// Survival time by mass ratio and mode parameter: one cell each, blue if stable, orange if it
/// fails, paler for later failures. The current run is framed, and a line over constant N shows the
/// mean N of adaptive sub-stepping. @param width logical pixels
/// @return the result whose cell is pressed, dragged over or reached by an arrow key
std::optional<std::size_t> stability_map(const Look& look, const Lab& lab, float width);
/// The conclusion of the comparison with a constant N, and the choice of its alpha.
void trade_head(const Look& look, Accuracy& accuracy);
/// Sub-steps per frame under each load: a bar for adaptive sub-stepping and one for the smallest
/// constant N that is as accurate, each with its error; a line for the constant N that serves all
/// loads. @param width logical pixels @return the result whose bar was clicked
std::optional<std::size_t> trade_chart(const Look& look, Accuracy& accuracy, float width);
/// Rectangles of the runs: the whole view, or equal parts side by side or stacked, whichever shows
/// the scene larger.
std::vector<ViewRect> view_panes(const Compare& compare, const Desk& desk,
                                 const Viewport& viewport);
/// The part of the window covered by a pane's picture.
Part part_of_window(const Viewport& viewport, std::size_t pane);
/// The legend of the compared runs; draws nothing without a comparison.
void compare_legend(const Look& look, const Session& session, const Compare& compare, Desk& desk,
                    const Viewport& viewport);
/// The guided tour's card, or the button that opens it.
/// @param words of the current step; null outside the tour, and if the page shows them
void tour(const Look& look, Desk& desk, const Viewport& viewport, const TourWords* words);
inline constexpr const char* kTourTip = "The paper's method in eight steps";
/// Title of this run in a comparison.
std::string run_title(const Session& session, const Compare& compare);
/// @param brief without the list of stages
void timing(const Look& look, const Session& session, bool brief);
/// A speed of the simulation relative to real time.
struct Speed {
  double value;
  const char* name;
};
inline constexpr std::array<Speed, 7> kSpeeds{{{0.0625, "1/16×"},
                                               {0.125, "1/8×"},
                                               {0.25, "1/4×"},
                                               {0.5, "1/2×"},
                                               {1.0, "1×"},
                                               {2.0, "2×"},
                                               {4.0, "4×"}}};
/// @param phone two rows, larger targets
void transport(App& app, bool phone);

/// The timeline slider of the run's past.
void scrubber(const Look& look, Session& session, ImVec2 at, float width, float height);
/// The button with the menu of links, files and pictures.
void share_menu(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport, float size);
void copy_command(Lab& lab);
/// Takes a screenshot of the whole window after this frame is drawn.
void capture_window(const Session& session, Desk& desk);
/// Begins the tour, or goes to its next step; ends it after the last one.
void advance_tour(Desk& desk);
/// The dialogue for choosing a scene file, while open.
void file_card(const Look& look, Lab& lab, const Viewport& viewport, FileBrowser& browser);

/// Over the picture: title, N, the scale of the tint, masses, and problems.
void caption(const Look& look, const Session& session, Desk& desk, const Viewport& viewport,
             bool phone);
void body_labels(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport);
void annotations(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport);
/// Rings around the joints of Desk::ringed and the one selected in "My model", with their names.
void joint_rings(const Look& look, const Lab& lab, const Desk& desk, const Viewport& viewport);
/// A ring around what failed in each run, with its measure.
void failure_rings(const Look& look, const Lab& lab, const Viewport& viewport);
/// On the first screen: a ring around the first joint that came apart, also as it opens further.
void first_tear(const Look& look, const Lab& lab, const Viewport& viewport);
void selection_card(const Look& look, const Session& session, Desk& desk, const Viewport& viewport,
                    bool phone);
void tint_scale(const Look& look, const Session& session, const Compare& compare, const Desk& desk,
                const Viewport& viewport);
void failure_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
void trouble_card(const Look& look, Lab& lab, const Viewport& viewport);
/// The reason why a run was not started, with a button to start it.
void heavy_card(const Look& look, Lab& lab, const Viewport& viewport);
/// Progress of a long frame, with a button to cancel it.
void long_frame_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);
void help_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport);

/// Heights of the right panel's fixed parts.
float why_summary_height();
float timing_height(const Look& look, const Session& session, bool brief);

}  // namespace ui
}  // namespace substep
