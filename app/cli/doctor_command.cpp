#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/diagnosis_html.hpp"
#include "core/io/diagnosis_json.hpp"
#include "core/lab/doctor_words.hpp"
#include "core/model/format_text.hpp"
#include "core/model/joint_fields.hpp"

namespace substep::cli {
namespace {

// Exit codes of this command.
constexpr int kHolds = 0;
constexpr int kHoldsNarrowly = 1;
constexpr int kFails = 2;
constexpr int kNotUnderstood = 3;

struct DoctorOptions {
  std::string scene;
  std::string json;
  std::string html;
  std::string badge;
  std::string engine = "substep";
  double step = 0.0;
  int held = 0;
  bool static_only = false;
  std::optional<double> seconds;
  BudgetFlags budget;
};

int exit_code_of(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::kHolds:
      return kHolds;
    case Diagnosis::Verdict::kHoldsNarrowly:
      return kHoldsNarrowly;
    case Diagnosis::Verdict::kFails:
      return kFails;
    case Diagnosis::Verdict::kNotUnderstood:
      break;
  }
  return kNotUnderstood;
}

/// The first shares above a hundredth, with names: "link_3 62 %, link_4 21 %"
std::string shares_text(const std::vector<LinearModel::Share>& shares, auto&& name) {
  constexpr double kLeast = 0.01;
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(shares.size(), kMost); ++i) {
    if (shares[i].share < kLeast) break;
    if (!text.empty()) text += ", ";
    text += name(shares[i].index) + format_text(" %.0f %%", 100.0 * shares[i].share);
  }
  return text;
}

class DoctorText {
 public:
  DoctorText(const Scene& scene, const Diagnosis& diagnosis) : scene_(scene), d_(diagnosis) {}

  void print(std::FILE* out) const {
    const DoctorQuestion& asked = d_.question;
    say(out, "%s: a step of %s in %s: %s\n", scene_.name.c_str(), step_text(asked.step).c_str(),
        asked.engine->title, word_of(d_.verdict));
    print_limit(out);
    for (const GroupLimit& limit : d_.start) print_group(out, limit);
    if (d_.too_large > 0) {
      say(out, "%d bodies are in groups of more than %d and were not analysed.\n", d_.too_large,
          LinearModel::kMostBodies);
    }
    print_drives(out);
    for (const Finding& finding : d_.findings) {
      say(out, "%s: %s\n", finding.fails ? "Fault" : "Warning", finding.text.c_str());
    }
    for (const DoctorRun& run : d_.runs) print_run(out, run);
    if (d_.at_step) {
      say(out, "\nRun %s: %s\n", d_.at_step->what.c_str(), d_.at_step->verdict.c_str());
      if (const std::string why = disagreement_of(d_); !why.empty()) {
        say(out, "  %s\n", why.c_str());
      }
    }
    print_remedies(out);
    print_engines(out);
  }

 private:
  [[nodiscard]] std::string joint(int i) const { return base(scene_.joints[index(i)]).name; }
  [[nodiscard]] std::string body(int i) const { return scene_.bodies[index(i)].name; }

  void print_limit(std::FILE* out) const {
    if (!std::isfinite(d_.step)) {
      say(out, "No limit was found: no joint force resists, and no drive or spring is explicit.\n");
      return;
    }
    say(out, "Largest step: %s, %.2g of the asked one; set by %s.\n", step_text(d_.step).c_str(),
        d_.step / d_.question.step, d_.limited_by.c_str());
  }

  void print_group(std::FILE* out, const GroupLimit& limit) const {
    const GroupFacts& group = d_.groups[limit.group];
    say(out,
        "\nGroup of %s: %zu %s, %d %s of freedom, at the start\n"
        "  largest step %s; of geometric stiffness alone, 2/w_max, %s; the paper's criterion, "
        "2/sqrt(r), %s\n",
        body(group.bodies[0]).c_str(), group.bodies.size(),
        group.bodies.size() == 1 ? "body" : "bodies", group.freedom,
        group.freedom == 1 ? "degree" : "degrees", step_text(limit.step).c_str(),
        step_text(limit.geometric).c_str(), step_text(limit.criterion).c_str());
    const auto of_joint = [this](int i) { return joint(i); };
    const auto of_body = [this](int i) { return body(i); };
    if (const std::string text = shares_text(limit.drives, of_joint); !text.empty()) {
      say(out, "  drives and springs in its stiffness: %s\n", text.c_str());
    }
    if (const std::string text = shares_text(limit.joints, of_joint); !text.empty()) {
      say(out, "  joints in its geometric stiffness: %s\n", text.c_str());
    }
    if (const std::string text = shares_text(limit.bodies, of_body); !text.empty()) {
      say(out, "  bodies that move: %s\n", text.c_str());
    }
  }

  void print_drives(std::FILE* out) const {
    if (d_.drives.empty()) return;
    const bool held = d_.question.held > 0;
    std::size_t longest = 0;
    for (const DriveLimit& drive : d_.drives) {
      longest = std::max(longest, joint(drive.joint).size());
    }
    const int width = static_cast<int>(longest);
    say(out,
        "\nDrives and springs: inertia and the armature that is missing, in kg m^2 (hinge) or kg "
        "(slide); "
        "largest step\n%-*s %9s %9s %9s %16s",
        width, "", "inertia", "armature", "explicit", "implicit damping");
    if (held) say(out, " %9s %9s", "held", "by delay");
    say(out, "\n");
    for (const DriveLimit& drive : d_.drives) {
      say(out, "%-*s %9.3g %9.3g %9s %16s", width, joint(drive.joint).c_str(), drive.inertia,
          drive.armature, step_text(drive.explicit_step).c_str(),
          step_text(drive.damped_step).c_str());
      if (held) {
        say(out, " %9s %9s", step_text(drive.held_step).c_str(),
            step_text(drive.delay_step).c_str());
      }
      say(out, "\n");
    }
    if (held) {
      say(out,
          "  A law held over %d steps needs damping above stiffness times step times %g; no "
          "armature changes that.\n",
          d_.question.held, 0.5 * (d_.question.held - 1));
    }
  }

  void print_run(std::FILE* out, const DoctorRun& run) const {
    if (run.criterion.empty()) return;
    const double least = *std::min_element(run.criterion.begin(), run.criterion.end());
    say(out, "\nRun %s, %g s with substep's adaptive sub-steps: %s\n", run.what.c_str(),
        run.seconds, run.verdict.c_str());
    say(out, "  the criterion's smallest step %s", step_text(least).c_str());
    if (run.leader >= 0) {
      say(out, " at %.3g s, by %s", run.leader_time, body(run.leader).c_str());
    }
    say(out, "\n");
    for (const GroupLimit& limit : run.worst) {
      if (!std::isfinite(limit.step)) continue;
      say(out, "  group of %s: largest step %s at %.3g s\n",
          body(d_.groups[limit.group].bodies[0]).c_str(), step_text(limit.step).c_str(),
          limit.time);
    }
  }

  void print_remedies(std::FILE* out) const {
    if (d_.remedies.empty()) return;
    say(out, "\nTried for %g s after the shake; distances from a fine run, in the first second:\n",
        d_.question.seconds);
    for (const TriedRemedy& tried : d_.remedies) {
      say(out, "  %s: %s; %.3g operations per second, %.2g times as many; off by %.2g m\n",
          tried.text.c_str(), tried.verdict.c_str(), tried.operations, tried.cost, tried.moved);
    }
  }

  void print_engines(std::FILE* out) const {
    const auto settings = engine_settings(scene_, d_);
    if (settings.empty()) return;
    say(out, "\nAt least, with a margin of %g (iterative engines may need more):\n", kSafeMargin);
    for (const EngineSetting& setting : settings) {
      say(out, "  %-28s %s%s\n", setting.engine->title, setting.text.c_str(),
          setting.assumed ? "  (its drives: assumed)" : "");
    }
  }

  const Scene& scene_;
  const Diagnosis& d_;
};

int doctor(const DoctorOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return kNotUnderstood;
  Output json;
  Output html;
  Output badge;
  if (!json.open(options.json) || !html.open(options.html) || !badge.open(options.badge)) {
    return kNotUnderstood;
  }
  DoctorQuestion question;
  question.step = options.step;
  question.engine = engine_of(options.engine);
  question.held = options.held;
  question.runs = !options.static_only;
  question.seconds = options.seconds.value_or(0.0);
  question.budget = options.budget.budget();
  const Diagnosis d = diagnose(scene, question);
  if (d.verdict == Diagnosis::Verdict::kNotUnderstood) {
    complain("%s: %s", options.scene.c_str(), d.problem.c_str());
    return kNotUnderstood;
  }
  if (json.is_open()) {
    json.write(diagnosis_json(*scene, d).dump(2, ' ', false, Json::error_handler_t::replace) +
               '\n');
    if (!json.close()) return kNotUnderstood;
  }
  if (html.is_open()) {
    html.write(diagnosis_html(*scene, d));
    if (!html.close()) return kNotUnderstood;
  }
  if (badge.is_open()) {
    badge.write(diagnosis_badge(d));
    if (!badge.close()) return kNotUnderstood;
  }
  const bool is_taken = is_standard_output(options.json) || is_standard_output(options.html) ||
                        is_standard_output(options.badge);
  if (!is_taken) DoctorText(*scene, d).print(stdout);
  return exit_code_of(d.verdict);
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand(
      "doctor", "Say which step a model needs, what sets it and what would help");
  command
      ->add_option("scene", options->scene,
                   "name or file of a scene, or file of a model, - for standard input")
      ->required();
  command->add_option("--step", options->step, "step of the engine [s] (default: the frame)")
      ->check(within(kStepRange.least, kStepRange.most));
  std::vector<std::string_view> names;
  for (const Engine& engine : kEngines) names.push_back(engine.name);
  command->add_option("--engine", options->engine, "engine whose treatment of drives counts")
      ->check(among(names))
      ->capture_default_str();
  command
      ->add_option("--held", options->held,
                   "drives are laws outside the engine, held over so many steps")
      ->check(whole(1, kMostHeld));
  command->add_option("--seconds", options->seconds, "length of each run [s]")
      ->check(within(kRunRange.least, kRunRange.most));
  command->add_flag("--no-runs", options->static_only, "analyse the start only");
  command
      ->add_option("--json", options->json,
                   "write the diagnosis to this file, - for standard output")
      ->check(named());
  command->add_option("--html", options->html, "write a report to this file")->check(named());
  command->add_option("--badge", options->badge, "write a picture for a README (SVG) to this file")
      ->check(named());
  options->budget.add_to(*command);
  for (const char* of_runs : {"--seconds", "--work-budget", "--memory-budget"}) {
    command->get_option(of_runs)->excludes("--no-runs");
  }
  command->footer(
      "The largest step is that of the linearised model with constraint forces frozen: exact for "
      "a\n"
      "model at rest, a bound in motion. Contacts are in the criterion and the runs alone.\n"
      "Exit code: 0 holds, 1 holds with a margin below 1.4, 2 fails, 3 not understood.\n"
      "Examples:\n"
      "  substep doctor pendulum\n"
      "  substep doctor swinging_box --step 5e-4 --engine mujoco --json diagnosis.json\n"
      "  substep doctor my_robot.xml --engine mujoco --step 0.002 --html step.html --badge "
      "step.svg");
  command->callback([options, &exit_code] {
    keep_apart({{"--json", options->json}, {"--html", options->html}, {"--badge", options->badge}},
               {scene_path(options->scene)});
    exit_code = doctor(*options);
  });
}

}  // namespace substep::cli
