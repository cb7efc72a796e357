#include "core/io/diagnosis_json.hpp"

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/object_reader.hpp"
#include "core/lab/doctor_words.hpp"
#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

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
          {"step", finite_or_null(limit.step)},
          {"geometric_step", finite_or_null(limit.geometric)},
          {"criterion_step", finite_or_null(limit.criterion)},
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
  for (const double step : run.criterion) steps.push_back(finite_or_null(step));
  out["criterion_steps"] = std::move(steps);
  Json worst = Json::array();
  for (const GroupLimit& limit : run.worst) worst.push_back(limit_json(scene, d, limit));
  out["worst"] = std::move(worst);
  return out;
}

}  // namespace

Json diagnosis_json(const Scene& scene, const Diagnosis& d) {
  Json out = {{"scene", scene.name},
              {"engine", d.question.engine->name},
              {"step", d.question.step},
              {"verdict", word_of(d.verdict)},
              {"largest_step", finite_or_null(d.step)},
              {"limited_by", d.limited_by},
              {"summary", summary_of(d)},
              {"by_drive", d.by_drive},
              {"not_analysed", d.too_large}};
  if (d.question.held > 0) out["held"] = d.question.held;
  Json joints = Json::array();
  for (const int joint : d.joints) {
    joints.push_back({{"index", joint}, {"name", base(scene.joints[index(joint)]).name}});
  }
  out["joints"] = std::move(joints);
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
                      {"inertia", finite_or_null(drive.inertia)},
                      {"stiffness", drive.stiffness},
                      {"damping", drive.damping},
                      {"explicit_step", finite_or_null(drive.explicit_step)},
                      {"implicit_damping_step", finite_or_null(drive.damped_step)},
                      {"held_step", finite_or_null(drive.held_step)},
                      {"delay_step", finite_or_null(drive.delay_step)},
                      {"step", finite_or_null(drive.step)},
                      {"armature_to_add", finite_or_null(drive.armature)}});
  }
  out["drives"] = std::move(drives);
  Json findings = Json::array();
  for (const Finding& finding : d.findings) {
    findings.push_back({{"fails", finding.fails}, {"text", finding.text}});
  }
  out["findings"] = std::move(findings);
  Json runs = Json::array();
  for (const DoctorRun& run : d.runs) runs.push_back(run_json(scene, d, run));
  if (d.at_step) {
    Json run = run_json(scene, d, *d.at_step);
    run["note"] = disagreement_of(d);
    runs.push_back(std::move(run));
  }
  out["runs"] = std::move(runs);
  Json remedies = Json::array();
  for (const TriedRemedy& tried : d.remedies) {
    remedies.push_back({{"text", tried.text},
                        {"holds", tried.holds},
                        {"verdict", tried.verdict},
                        {"foretold_step", finite_or_null(tried.step)},
                        {"operations_per_second", tried.operations},
                        {"cost", tried.cost},
                        {"moved", tried.moved}});
    if (tried.shorter > 0.0) remedies.back()["step"] = tried.shorter;
    remedies.back()["changes_model"] = tried.changed != nullptr;
  }
  out["remedies"] = std::move(remedies);
  Json settings = Json::array();
  for (const EngineSetting& setting : engine_settings(scene, d)) {
    settings.push_back({{"engine", setting.engine->name},
                        {"title", setting.engine->title},
                        {"setting", setting.text},
                        {"assumed", setting.assumed}});
  }
  out["settings"] = std::move(settings);
  return out;
}

std::optional<DoctorQuestion> read_question(const Json& json, Problems& problems) {
  const std::size_t before = problems.size();
  DoctorQuestion question;
  ObjectReader in(json, "", problems);
  std::vector<std::string_view> names;
  for (const Engine& engine : kEngines) names.push_back(engine.name);
  if (const auto engine = in.choice("engine", names, kOptional)) {
    question.engine = &kEngines.at(*engine);
  }
  in.number("step", kStepRange, question.step, kOptional);
  in.integer("held", 1, kMostHeld, question.held, kOptional);
  in.number("seconds", kRunRange, question.seconds, kOptional);
  in.flag("runs", question.runs, kOptional);
  in.finish();
  if (problems.size() > before) return std::nullopt;
  return question;
}

}  // namespace substep
