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
#include "core/io/json.hpp"
#include "core/lab/doctor.hpp"
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

const char* word_of(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::kHolds:
      return "holds";
    case Diagnosis::Verdict::kHoldsNarrowly:
      return "holds narrowly";
    case Diagnosis::Verdict::kFails:
      return "fails";
    case Diagnosis::Verdict::kNotUnderstood:
      break;
  }
  return "not understood";
}

/// "2.38 ms", or "no limit"
std::string time_text(double seconds) {
  if (!std::isfinite(seconds)) return "no limit";
  return seconds < 0.1 ? format_text("%.3g ms", 1e3 * seconds) : format_text("%.3g s", seconds);
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
    say(out, "%s: a step of %s in %s: %s\n", scene_.name.c_str(), time_text(asked.step).c_str(),
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
      if (!d_.at_step->holds && d_.step > d_.question.step) {
        say(out,
            "  It fails below the largest step: by errors that are not those of the linearised "
            "motion.\n");
      }
      if (d_.at_step->holds && d_.step < d_.question.step) {
        say(out, d_.by_drive ? "  Drives and springs of substep are implicit.\n"
                             : "  It holds above the largest step: for these seconds, not for "
                               "certain.\n");
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
    say(out, "Largest step: %s, %.2g of the asked one; set by %s.\n", time_text(d_.step).c_str(),
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
        group.freedom == 1 ? "degree" : "degrees", time_text(limit.step).c_str(),
        time_text(limit.geometric).c_str(), time_text(limit.criterion).c_str());
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
          drive.armature, time_text(drive.explicit_step).c_str(),
          time_text(drive.damped_step).c_str());
      if (held) {
        say(out, " %9s %9s", time_text(drive.held_step).c_str(),
            time_text(drive.delay_step).c_str());
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
    say(out, "  the criterion's smallest step %s", time_text(least).c_str());
    if (run.leader >= 0) {
      say(out, " at %.3g s, by %s", run.leader_time, body(run.leader).c_str());
    }
    say(out, "\n");
    for (const GroupLimit& limit : run.worst) {
      if (!std::isfinite(limit.step)) continue;
      say(out, "  group of %s: largest step %s at %.3g s\n",
          body(d_.groups[limit.group].bodies[0]).c_str(), time_text(limit.step).c_str(),
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
    if (!std::isfinite(d_.step)) return;
    const double step = d_.step / kSafeMargin;
    say(out, "\nAt least, with a margin of %g (iterative engines may need more):\n", kSafeMargin);
    for (const Engine& engine : kEngines) {
      double of = step;
      if (&engine != d_.question.engine) {
        const bool same = engine.stiffness == d_.question.engine->stiffness &&
                          engine.damping == d_.question.engine->damping &&
                          engine.damps_springs == d_.question.engine->damps_springs;
        if (!same && !d_.drives.empty()) continue;  // another question
      }
      of = std::min(of, scene_.frame);
      const int count = static_cast<int>(std::ceil(scene_.frame / of * (1.0 - 1e-12)));
      say(out, "  %-28s %s%s\n", engine.title, setting_of(engine, of, count).c_str(),
          engine.assumed && !d_.drives.empty() ? "  (its drives: assumed)" : "");
    }
  }

  const Scene& scene_;
  const Diagnosis& d_;
};

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json shares_json(const std::vector<LinearModel::Share>& shares, auto&& name) {
  Json list = Json::array();
  for (const LinearModel::Share& share : shares) {
    list.push_back({{"name", name(share.index)}, {"share", share.share}});
  }
  return list;
}

Json limit_json(const Scene& scene, const Diagnosis& d, const GroupLimit& limit) {
  const auto joint = [&](int i) { return base(scene.joints[index(i)]).name; };
  const auto body = [&](int i) { return scene.bodies[index(i)].name; };
  return {{"group", body(d.groups[limit.group].bodies[0])},
          {"time", limit.time},
          {"step", number(limit.step)},
          {"geometric_step", number(limit.geometric)},
          {"criterion_step", number(limit.criterion)},
          {"drives", shares_json(limit.drives, joint)},
          {"joints", shares_json(limit.joints, joint)},
          {"bodies", shares_json(limit.bodies, body)}};
}

Json run_json(const Scene& scene, const Diagnosis& d, const DoctorRun& run) {
  Json out = {{"run", run.what},
              {"seconds", run.seconds},
              {"holds", run.holds},
              {"verdict", run.verdict},
              {"operations_per_second", run.operations}};
  if (run.leader >= 0) out["leader"] = scene.bodies[index(run.leader)].name;
  Json steps = Json::array();
  for (const double step : run.criterion) steps.push_back(number(step));
  out["criterion_steps"] = std::move(steps);
  Json worst = Json::array();
  for (const GroupLimit& limit : run.worst) worst.push_back(limit_json(scene, d, limit));
  out["worst"] = std::move(worst);
  return out;
}

Json doctor_json(const Scene& scene, const Diagnosis& d) {
  Json out = {{"scene", scene.name},
              {"engine", d.question.engine->name},
              {"step", d.question.step},
              {"verdict", word_of(d.verdict)},
              {"largest_step", number(d.step)},
              {"limited_by", d.limited_by}};
  Json groups = Json::array();
  for (const GroupLimit& limit : d.start) {
    Json group = limit_json(scene, d, limit);
    const GroupFacts& facts = d.groups[limit.group];
    group["size"] = facts.bodies.size();
    group["freedom"] = facts.freedom;
    group["redundant_rows"] = facts.redundant;
    groups.push_back(std::move(group));
  }
  out["start"] = std::move(groups);
  Json drives = Json::array();
  for (const DriveLimit& drive : d.drives) {
    drives.push_back({{"joint", base(scene.joints[index(drive.joint)]).name},
                      {"inertia", number(drive.inertia)},
                      {"stiffness", drive.stiffness},
                      {"damping", drive.damping},
                      {"explicit_step", number(drive.explicit_step)},
                      {"implicit_damping_step", number(drive.damped_step)},
                      {"held_step", number(drive.held_step)},
                      {"delay_step", number(drive.delay_step)},
                      {"step", number(drive.step)},
                      {"armature_to_add", number(drive.armature)}});
  }
  out["drives"] = std::move(drives);
  Json findings = Json::array();
  for (const Finding& finding : d.findings) {
    findings.push_back({{"fails", finding.fails}, {"text", finding.text}});
  }
  out["findings"] = std::move(findings);
  Json runs = Json::array();
  for (const DoctorRun& run : d.runs) runs.push_back(run_json(scene, d, run));
  if (d.at_step) runs.push_back(run_json(scene, d, *d.at_step));
  out["runs"] = std::move(runs);
  Json remedies = Json::array();
  for (const TriedRemedy& tried : d.remedies) {
    remedies.push_back({{"text", tried.text},
                        {"holds", tried.holds},
                        {"verdict", tried.verdict},
                        {"foretold_step", number(tried.step)},
                        {"operations_per_second", tried.operations},
                        {"cost", tried.cost},
                        {"moved", tried.moved}});
  }
  out["remedies"] = std::move(remedies);
  return out;
}

int doctor(const DoctorOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return kNotUnderstood;
  Output json;
  if (!json.open(options.json)) return kNotUnderstood;
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
    json.write(doctor_json(*scene, d).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    if (!json.close()) return kNotUnderstood;
  }
  if (!is_standard_output(options.json)) DoctorText(*scene, d).print(stdout);
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
      ->check(within(1e-5, 1.0));
  std::vector<std::string_view> names;
  for (const Engine& engine : kEngines) names.push_back(engine.name);
  command->add_option("--engine", options->engine, "engine whose treatment of drives counts")
      ->check(among(names))
      ->capture_default_str();
  command
      ->add_option("--held", options->held,
                   "drives are laws outside the engine, held over so many steps")
      ->check(whole(1, 1000));
  command->add_option("--seconds", options->seconds, "length of each run [s]")
      ->check(within(1e-3, 86400.0));
  command->add_flag("--no-runs", options->static_only, "analyse the start only");
  command
      ->add_option("--json", options->json,
                   "write the diagnosis to this file, - for standard output")
      ->check(named());
  options->budget.add_to(*command);
  command->footer(
      "The largest step is that of the linearised model with constraint forces frozen: exact for "
      "a\n"
      "model at rest, a bound in motion. Contacts are in the criterion and the runs alone.\n"
      "Exit code: 0 holds, 1 holds with a margin below 1.4, 2 fails, 3 not understood.\n"
      "Examples:\n"
      "  substep doctor pendulum\n"
      "  substep doctor swinging_box --step 5e-4 --engine mujoco --json diagnosis.json");
  command->callback([options, &exit_code] {
    keep_apart({{"--json", options->json}}, {scene_path(options->scene)});
    exit_code = doctor(*options);
  });
}

}  // namespace substep::cli
