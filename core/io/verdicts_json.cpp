#include "core/io/verdicts_json.hpp"

#include <string_view>

#include "core/model/names.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

Expectation read_rule(const Json& json, const std::string& pointer, Problems& problems) {
  ObjectReader in(json, pointer, problems);
  Expectation rule;
  if (!in.is_object()) return rule;
  rule.solver = in.choice<SolverKind>("solver", kOptional);
  rule.mode = in.choice<Mode>("mode", kOptional);
  const CountSetting& n_field = std::get<CountSetting>(find_setting("n")->member);
  int n = 0;
  if (in.integer("n", n_field.least, n_field.most, n, kOptional)) {
    rule.n = n;
    if (rule.mode != Mode::kConst) in.problem("n", "is allowed in mode const only");
  }
  rule.integrator = in.choice<Integrator>("integrator", kOptional);
  const auto verdict = in.choice<Expected>("verdict", kRequired);
  rule.verdict = verdict.value_or(Expected::kHolds);
  double before = 0.0;
  if (in.number("before", kDurationRange, before, kOptional)) {
    rule.before = before;
    if (verdict && *verdict != Expected::kFails)
      in.problem("before", "is allowed with verdict fails only");
  }
  in.text("why", kMaxProse, rule.why, kOptional);
  if (verdict == Expected::kDepends && rule.why.empty()) {
    in.problem("why", "missing: depends needs a reason");
  }
  in.finish();
  return rule;
}

}  // namespace

Expectations read_verdicts(ObjectReader& scene, Problems& problems) {
  Expectations rules;
  const Json* list = scene.list("verdicts", kMaxVerdictRules, kOptional);
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    rules.push_back(read_rule((*list)[i], pointer_to(scene.pointer("verdicts"), i), problems));
  }
  return rules;
}

Json verdicts_json(const Expectations& rules) {
  Json list = Json::array();
  for (const Expectation& rule : rules) {
    Json json;
    if (rule.solver) json["solver"] = name_of(*rule.solver);
    if (rule.mode) json["mode"] = name_of(*rule.mode);
    if (rule.n) json["n"] = *rule.n;
    if (rule.integrator) json["integrator"] = name_of(*rule.integrator);
    json["verdict"] = name_of(rule.verdict);
    if (rule.before) json["before"] = *rule.before;
    if (!rule.why.empty()) json["why"] = rule.why;
    list.push_back(json);
  }
  return list;
}

}  // namespace substep
