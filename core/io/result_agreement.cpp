#include "core/io/result_agreement.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include "core/io/object_reader.hpp"
#include "core/model/format_text.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

class Agreement {
 public:
  Agreement(const Json& line, const Experiment& experiment, Problems& problems)
      : line_(line), experiment_(experiment), problems_(problems) {}

  void check_experiment() {
    expect("id", experiment_id(experiment_), "the id of this experiment");
    expect("series", series_name(experiment_.settings), "the series of these settings");
    const SeriesParameter parameter = series_parameter(experiment_.settings);
    const Json& found = line_["parameter"];
    if (found["name"] == parameter.name && found["value"].get<double>() == parameter.value) return;
    problem("/parameter", must_be(std::string(parameter.name) + " = " +
                                      number_text(parameter.value) + ", as in the settings",
                                  value_text(found["name"]) + " = " + value_text(found["value"])));
  }

  void check_verdict() {
    const Json& verdict = line_["verdict"];
    if (holds_ == line_.contains("failed_at")) {
      problem("/failed_at", holds_ ? "is allowed for a failed run only" : "missing");
      return;
    }
    const std::string begins =
        holds_ ? "" : format_text("fails at %.3f s: ", line_["failed_at"].get<double>());
    if (holds_ ? verdict != "holds" : !verdict.get_ref<const std::string&>().starts_with(begins)) {
      problem("/verdict",
              must_be(holds_ ? "\"holds\"" : "\"" + begins + "...\"", value_text(verdict)));
    }
  }

  // The number of frames is rounded. A failed run ends within its last frame.
  void check_frames() {
    const double frames = count("frames");
    const double seconds = experiment_.duration;
    const double end = holds_ ? seconds : line_["failed_at"].get<double>();
    const double longest = kFrameRange.most;
    if (end > seconds + 0.5 * longest) {
      return problem("/failed_at", must_be("at most seconds, " + number_text(seconds),
                                           value_text(line_["failed_at"])));
    }
    const double least = std::floor(end / longest);
    const double most = std::ceil(seconds / kFrameRange.least);
    if (frames < least || frames > most) {
      problem(of_work("frames"), must_be("from " + number_text(least) + " to " + number_text(most) +
                                             ", for " + number_text(end) + " s",
                                         value_text(line_["work"]["frames"])));
    }
  }

  void check_substeps() {
    const double frames = count("frames");
    if (frames == 0.0) {
      for (const auto& [name, value] : line_["work"].items()) {
        if (value.is_number() && value != 0)
          problem(of_work(name), must_be("0 in a run without frames", value_text(value)));
      }
      return;
    }
    const double n_min = count("n_min");
    const double n_max = count("n_max");
    if (n_min > count("n_median") || count("n_median") > n_max) {
      problem(of_work("n_median"), "n_min, n_median and n_max must not decrease");
      return;
    }
    const double least = (frames - 1.0) * n_min + n_max;
    if (count("substeps") < least) {
      problem(of_work("substeps"),
              must_be("at least " + number_text(least) + ", by the frames, n_min and n_max",
                      value_text(line_["work"]["substeps"])));
    }
  }

  void check_peaks() {
    const Json& errors = line_["errors"];
    at_most(errors, "/errors", "trajectory_final", "trajectory_peak");
    at_most(errors, "/errors", "energy_drift", "energy_drift_peak");
    for (const std::string_view name : {"constraint", "joint_gap", "penetration"}) {
      const auto found = errors.find(name);
      if (found != errors.end()) {
        at_most(*found, "/errors/" + std::string(name), "median", "peak");
      }
    }
    at_most(line_["timing"], "/timing", "ms_median", "ms_p95");
  }

 private:
  void problem(std::string pointer, std::string what) {
    problems_.push_back({std::move(pointer), std::move(what)});
  }

  void expect(const std::string& name, const Json& expected, const std::string& why) {
    const Json& value = line_[name];
    if (value != expected) {
      problem('/' + name, must_be(value_text(expected) + ", " + why, value_text(value)));
    }
  }

  /// The pointer to a field of "work".
  static std::string of_work(const std::string& name) {
    return (Json::json_pointer() / "work" / name).to_string();
  }

  double count(const std::string& name) { return line_["work"][name].get<double>(); }

  void at_most(const Json& part, const std::string& pointer, const std::string& name,
               const std::string& peak) {
    const auto value = part.find(name);
    const auto most = part.find(peak);
    if (value == part.end() || most == part.end()) return;
    if (!value->is_number() || !most->is_number()) return;  // not finite, in a failed run
    if (std::abs(value->get<double>()) <= most->get<double>()) return;
    problem(pointer + '/' + name,
            must_be("at most " + peak + ", " + value_text(*most), value_text(*value)));
  }

  const Json& line_;
  const Experiment& experiment_;
  Problems& problems_;
  bool holds_ = line_["holds"].get<bool>();
};

}  // namespace

void check_result_agreement(const Json& line, const Experiment& experiment, Problems& problems) {
  const std::size_t before = problems.size();
  Agreement agreement(line, experiment, problems);
  agreement.check_experiment();
  agreement.check_verdict();
  if (problems.size() > before) return;
  agreement.check_frames();
  agreement.check_substeps();
  agreement.check_peaks();
}

}  // namespace substep
