#include "core/io/stored_sweep.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "core/io/experiment.hpp"
#include "core/lab/axes.hpp"
#include "core/lab/sweep.hpp"
#include "core/math/hash.hpp"
#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

constexpr std::string_view kHeader = "substep-sweep 1 ";
constexpr const char* kHolds = "holds";
constexpr const char* kHash = " #";

/// Every fourth value of a curve comes first, then every second, then the rest; the map last.
constexpr std::size_t kMapRound = 3;
std::size_t round_of(std::size_t along_curve) {
  if (along_curve % 4 == 0) return 0;
  return along_curve % 2 == 0 ? 1 : 2;
}

std::string four_digits(double value) { return format_text("%.4g", value); }

std::string error_text(const std::optional<double>& error) {
  return error ? four_digits(*error) : "-";
}

/// " #0123abcd", which the program is shipped without.
std::string hash_text(const Metrics& m) {
  Hash hash;
  hash.add(m.hash);
  for (const std::int64_t count : {m.work.frames, m.work.substeps, m.work.solves, m.work.flops}) {
    hash.add(static_cast<std::uint64_t>(count));
  }
  hash.add(m.errors.energy_drift_peak);
  for (const auto& error : {m.errors.joint_gap, m.errors.penetration}) {
    hash.add(error ? error->peak : -1.0);
  }
  return kHash + hex_text(hash.value()).substr(0, 8);
}

std::string line_of(const Result& result) {
  const Metrics& m = result.metrics;
  const std::string work = std::to_string(m.work.substeps) + ' ' + std::to_string(m.work.flops);
  if (!m.holds) {
    return "! " + std::to_string(m.work.frames) + ' ' + work + ' ' + number_text(m.failed_at) +
           ' ' + m.verdict + hash_text(m);
  }
  std::string line = work;
  for (const ErrorAxis axis :
       {ErrorAxis::kTrajectory, ErrorAxis::kEnergy, ErrorAxis::kGap, ErrorAxis::kPenetration}) {
    line += ' ' + error_text(error_of(result, axis));
  }
  return line + hash_text(m);
}

/// Parses the text; missing values or invalid numbers make ok() false.
class Fields {
 public:
  explicit Fields(std::string_view text) : text_(text) {}
  [[nodiscard]] bool ok() const { return ok_; }

  std::string_view until(char end) {
    const std::string_view field = text_.substr(0, text_.find(end));
    ok_ = ok_ && (!field.empty() || !text_.empty());
    text_.remove_prefix(std::min(field.size() + 1, text_.size()));
    return field;
  }
  std::string_view line() { return until('\n'); }
  double number() { return taken(parse_number(until(' '))); }
  std::int64_t count() { return taken(parse_integer(until(' '))); }
  std::optional<double> error() {
    const std::string_view field = until(' ');
    return field == "-" ? std::nullopt : std::optional(taken(parse_number(field)));
  }

 private:
  template <class T>
  T taken(const std::optional<T>& value) {
    ok_ = ok_ && value.has_value();
    return value.value_or(T{});
  }

  std::string_view text_;
  bool ok_ = true;
};

std::optional<PeakAndMedian> peak_alone(const std::optional<double>& peak) {
  return peak ? std::optional(PeakAndMedian{*peak, 0.0}) : std::nullopt;
}

bool read_line(std::string_view line, std::int64_t frames, Metrics& m) {
  line = line.substr(0, line.find(kHash));
  m.holds = !line.starts_with("! ");
  if (!m.holds) line.remove_prefix(2);
  Fields in(line);
  m.work.frames = m.holds ? frames : in.count();
  m.work.substeps = in.count();
  m.work.flops = in.count();
  if (m.holds) {
    m.verdict = kHolds;
    m.errors.trajectory_peak = in.error();
    m.errors.energy_drift_peak = in.number();
    m.errors.joint_gap = peak_alone(in.error());
    m.errors.penetration = peak_alone(in.error());
  } else {
    m.failed_at = in.number();
    m.verdict = in.line();
  }
  return in.ok();
}

/// Id of the experiments in this order.
std::string plan_id(std::span<const Experiment> experiments) {
  Hash hash;
  for (const Experiment& experiment : experiments) {
    for (const char c : experiment_id(experiment)) hash.add(static_cast<std::uint64_t>(c));
  }
  return hex_text(hash.value());
}

}  // namespace

std::vector<Experiment> quick_sweep(const Scene& scene) {
  Experiment experiment = experiment_of(scene, scene.settings);
  // Beyond its window the motion cannot be predicted; longer runs would only take more time.
  experiment.duration = predictable_window(scene, scene.criteria.duration);
  std::array<std::vector<Experiment>, kMapRound + 1> rounds;
  std::map<std::string, std::size_t> along;
  for (const SweepPoint& point : default_sweep(scene)) {
    experiment.settings = point.settings;
    experiment.load = point.load;
    const bool on_map = point.load != 1.0;
    rounds[on_map ? kMapRound : round_of(along[series_name(point.settings)]++)].push_back(
        experiment);
  }
  std::vector<Experiment> all;
  for (const auto& round : rounds) all.insert(all.end(), round.begin(), round.end());
  return all;
}

std::string sweep_text(std::span<const Result> results, const ReferenceSummary& reference) {
  std::vector<Experiment> experiments;
  for (const Result& result : results) experiments.push_back(result.experiment);
  std::string text = std::string(kHeader) + plan_id(experiments) + '\n';
  text += four_digits(reference.uncertainty) + ' ' + number_text(reference.window) + ' ' +
          four_digits(reference.energy_scale) + '\n';
  text += reference.source + '\n' + reference.energy_scale_source + '\n';
  for (const Result& result : results) text += line_of(result) + '\n';
  return text;
}

std::optional<StoredSweep> read_sweep(std::string_view text, const Scene& scene) {
  if (!text.starts_with(kHeader)) return std::nullopt;
  const std::vector<Experiment> experiments = quick_sweep(scene);
  text.remove_prefix(kHeader.size());
  Fields in(text);
  if (in.line() != plan_id(experiments)) return std::nullopt;
  StoredSweep sweep;
  Fields about(in.line());
  sweep.reference.uncertainty = about.number();
  sweep.reference.window = about.number();
  sweep.reference.energy_scale = about.number();
  sweep.reference.source = in.line();
  sweep.reference.energy_scale_source = in.line();
  for (const Experiment& experiment : experiments) {
    Result& result = sweep.results.emplace_back();
    result.experiment = experiment;
    result.reference = sweep.reference;
    const std::int64_t frames = frames_of(scene, experiment.duration);
    if (!read_line(in.line(), frames, result.metrics)) return std::nullopt;
  }
  return in.ok() && about.ok() ? std::optional(std::move(sweep)) : std::nullopt;
}

}  // namespace substep
