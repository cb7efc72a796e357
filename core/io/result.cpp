#include "core/io/result.hpp"

#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/object_reader.hpp"

namespace substep {
namespace {

template <class T>
void put(Json& json, const char* key, const std::optional<T>& value) {
  if (!value) return;
  if constexpr (std::is_same_v<T, PeakAndMedian>) {
    json[key] = {{"peak", value->peak}, {"median", value->median}};
  } else {
    json[key] = *value;
  }
}

Json errors_json(const Errors& e) {
  Json json;
  put(json, "trajectory_peak", e.trajectory_peak);
  put(json, "trajectory_final", e.trajectory_final);
  put(json, "constraint", e.constraint);
  put(json, "joint_gap", e.joint_gap);
  put(json, "penetration", e.penetration);
  json["energy_drift"] = e.energy_drift;
  json["energy_drift_peak"] = e.energy_drift_peak;
  put(json, "energy_drift_percent", e.energy_drift_percent);
  put(json, "linear_momentum_drift", e.linear_momentum_drift);
  put(json, "angular_momentum_drift", e.angular_momentum_drift);
  json["lcp_residual"] = e.lcp_residual;
  return json;
}

Json reference_json(const ReferenceSummary& r) {
  return {{"source", r.source},
          {"uncertainty", r.uncertainty},
          {"window", r.window},
          {"energy_scale", r.energy_scale},
          {"energy_scale_source", r.energy_scale_source}};
}

}  // namespace

Json work_json(const Work& w) {
  return {{"frames", w.frames},
          {"substeps", w.substeps},
          {"solves", w.solves},
          {"row_updates", w.row_updates},
          {"factorisations", w.factorisations},
          {"pivots", w.pivots},
          {"unsettled", w.unsettled},
          {"unsolved", w.unsolved},
          {"flops", w.flops},
          {"visits", w.visits},
          {"rows",
           {{"joint", w.rows.joint}, {"contact", w.rows.contact}, {"friction", w.rows.friction}}},
          {"criterion", {{"evaluations", w.criterion.evaluations}, {"flops", w.criterion.flops}}},
          {"n_min", w.n_min},
          {"n_median", w.n_median},
          {"n_max", w.n_max}};
}

Json timing_json(const Timing& t) {
  const StageTimes& s = t.stages;
  return {{"ms_median", t.ms_median},
          {"ms_p95", t.ms_p95},
          {"real_time_factor", t.real_time_factor},
          {"stages",
           {{"joints", s.joints},
            {"contact", s.contact},
            {"friction", s.friction},
            {"mass", s.mass},
            {"solve", s.solve},
            {"stiffness", s.stiffness},
            {"integrate", s.integrate},
            {"total", s.total}}}};
}

Json costs_json(const CostBreakdown& costs) {
  Json json{{"work", work_json(costs.run.work)}, {"timing", timing_json(costs.run.timing)}};
  Json& effects = json["effects"] = Json::object();
  for (const EffectCost& effect : costs.effects) {
    effects[std::string(effect.effect)] = {
        {"ms", effect.ms}, {"flops", effect.flops}, {"row_updates", effect.row_updates}};
  }
  return json;
}

std::string results_header() {
  Json json;
  json["format"] = "substep-results";
  json["version"] = kResultsVersion;
  return json.dump() + '\n';
}

void check_results_header(std::string_view line, Problems& problems) {
  const auto json = parse_json(line, problems);
  if (!json) return;
  ObjectReader in(*json, "", problems);
  const Json* format = in.member("format", kRequired);
  if (format && *format != "substep-results") {
    in.problem("format", must_be("\"substep-results\"", value_text(*format)));
  }
  const Json* version = in.member("version", kRequired);
  if (version && *version != kResultsVersion) {
    in.problem("version", must_be(std::to_string(kResultsVersion) + ", the only known version",
                                  value_text(*version)));
  }
}

Json result_json(const Result& result) {
  const Metrics& m = result.metrics;
  const SeriesParameter parameter = series_parameter(result.experiment.settings);
  Json json = experiment_json(result.experiment);
  json["series"] = series_name(result.experiment.settings);
  json["parameter"] = {{"name", parameter.name}, {"value", parameter.value}};
  json["holds"] = m.holds;
  if (!m.holds) json["failed_at"] = m.failed_at;
  json["verdict"] = m.verdict;
  json["hash"] = hex_text(m.hash);
  json["errors"] = errors_json(m.errors);
  json["reference"] = reference_json(result.reference);
  json["work"] = work_json(m.work);
  json["timing"] = timing_json(m.timing);
  return json;
}

}  // namespace substep
