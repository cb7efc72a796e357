#include "core/io/verdicts_json.hpp"

#include <string_view>

#include "core/model/names.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

/// A member that is the name of one of the values of Enum.
template <class Enum>
std::optional<Enum> read_name(ObjectReader& in, std::string_view key, Presence presence) {
  std::string text;
  if (!in.text(key, kMaxNameSize, text, presence)) return std::nullopt;
  const auto value = value_of<Enum>(text);
  if (!value) {
    std::vector<std::string_view> names;
    for (const auto& entry : NameTable<Enum>::entries) names.push_back(entry.name);
    in.problem(key, must_be(one_of(names), value_text(text)));
  }
  return value;
}

Expectation read_rule(const Json& json, const std::string& pointer, Problems& problems) {
  ObjectReader in(json, pointer, problems);
  Expectation rule;
  if (!in.is_object()) return rule;
  rule.solver = read_name<SolverKind>(in, "solver", kOptional);
  rule.mode = read_name<Mode>(in, "mode", kOptional);
  const CountSetting& n_field = std::get<CountSetting>(find_setting("n")->member);
  int n = 0;
  if (in.integer("n", n_field.least, n_field.most, n, kOptional)) {
    rule.n = n;
    if (rule.mode != Mode::kConst) in.problem("n", "is allowed in mode const only");
  }
  rule.integrator = read_name<Integrator>(in, "integrator", kOptional);
  const auto verdict = read_name<Expected>(in, "verdict", kRequired);
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
  const Json* list = scene.member("verdicts", kOptional);
  if (!list) return rules;
  if (!list->is_array()) {
    scene.problem("verdicts", must_be("a list", value_text(*list)));
  } else if (list->size() > kMaxVerdictRules) {
    scene.problem("verdicts", too_many(list->size(), kMaxVerdictRules, "items"));
  } else {
    for (std::size_t i = 0; i < list->size(); ++i) {
      rules.push_back(read_rule((*list)[i], pointer_to(scene.pointer("verdicts"), i), problems));
    }
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
