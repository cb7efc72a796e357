#include "core/io/result_reader.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/io/experiment.hpp"
#include "core/io/object_reader.hpp"
#include "core/io/result_agreement.hpp"
#include "core/io/settings_json.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

enum class Type {
  kObject,
  kText,  // may be empty
  kHash,  // 16 hexadecimal digits
  kFlag,  // true or false
  kNumber,
  kError,        // a number; null if the run failed and it is not finite
  kOfReference,  // a number; null if the reference failed and it is not finite
  kCount,        // a whole number
};

/// A field of a result.
struct Field {
  std::string_view part;  // path to its object
  std::string_view name;
  Type type = Type::kNumber;
  Range range{};  // of numbers and counts
  Presence presence = kRequired;
};

constexpr double kMostCount = 9007199254740992.0;  // 2^53: doubles count exactly up to it
constexpr Range kAnyCount{0.0, kMostCount};
constexpr Range kSubstepsOfFrame{0.0, 1e6};
constexpr Range kAny;
constexpr Range kNotNegative{.least = 0.0};
constexpr Range kSeconds{.least = 0.0, .most = kDurationRange.most, .unit = "s"};

// An object precedes its members.
constexpr Field kResultFields[] = {
    {"", "id", Type::kHash},
    {"", "scene", Type::kText},
    {"", "scene_hash", Type::kHash},
    {"", "settings", Type::kObject},
    {"", "seconds", Type::kNumber, kSeconds},
    {"", "load", Type::kNumber, kLoadRange},
    {"", "seed", Type::kCount, {0.0, kMostSeed}},
    {"", "series", Type::kText},
    {"", "parameter", Type::kObject},
    {"", "holds", Type::kFlag},
    {"", "failed_at", Type::kNumber, kNotNegative, kOptional},
    {"", "verdict", Type::kText},
    {"", "hash", Type::kHash},
    {"", "errors", Type::kObject},
    {"", "reference", Type::kObject},
    {"", "work", Type::kObject},
    {"", "timing", Type::kObject},
    {"parameter", "name", Type::kText},
    {"parameter", "value", Type::kNumber, kNotNegative},
    {"errors", "trajectory_peak", Type::kError, kNotNegative, kOptional},
    {"errors", "trajectory_final", Type::kError, kNotNegative, kOptional},
    {"errors", "constraint", Type::kObject, kAny, kOptional},
    {"errors", "joint_gap", Type::kObject, kAny, kOptional},
    {"errors", "penetration", Type::kObject, kAny, kOptional},
    {"errors", "energy_drift", Type::kError, kAny},
    {"errors", "energy_drift_peak", Type::kError, kNotNegative},
    {"errors", "energy_drift_percent", Type::kError, kAny, kOptional},
    {"errors", "linear_momentum_drift", Type::kError, kNotNegative, kOptional},
    {"errors", "angular_momentum_drift", Type::kError, kNotNegative, kOptional},
    {"errors", "lcp_residual", Type::kError, kNotNegative},
    {"errors/constraint", "peak", Type::kError, kNotNegative},
    {"errors/constraint", "median", Type::kError, kNotNegative},
    {"errors/joint_gap", "peak", Type::kError, kNotNegative},
    {"errors/joint_gap", "median", Type::kError, kNotNegative},
    {"errors/penetration", "peak", Type::kError, kNotNegative},
    {"errors/penetration", "median", Type::kError, kNotNegative},
    {"reference", "source", Type::kText},
    {"reference", "uncertainty", Type::kOfReference, kNotNegative},
    {"reference", "window", Type::kNumber, kNotNegative},
    {"reference", "energy_scale", Type::kOfReference, kNotNegative},
    {"reference", "energy_scale_source", Type::kText},
    {"work", "frames", Type::kCount, kAnyCount},
    {"work", "substeps", Type::kCount, kAnyCount},
    {"work", "solves", Type::kCount, kAnyCount},
    {"work", "row_updates", Type::kCount, kAnyCount},
    {"work", "factorisations", Type::kCount, kAnyCount},
    {"work", "pivots", Type::kCount, kAnyCount},
    {"work", "unsettled", Type::kCount, kAnyCount},
    {"work", "unsolved", Type::kCount, kAnyCount},
    {"work", "flops", Type::kCount, kAnyCount},
    {"work", "n_min", Type::kCount, kSubstepsOfFrame},
    {"work", "n_median", Type::kCount, kSubstepsOfFrame},
    {"work", "n_max", Type::kCount, kSubstepsOfFrame},
    // Files of older versions lack these.
    {"work", "visits", Type::kCount, kAnyCount, kOptional},
    {"work", "rows", Type::kObject, kAny, kOptional},
    {"work", "criterion", Type::kObject, kAny, kOptional},
    {"work/rows", "joint", Type::kCount, kAnyCount},
    {"work/rows", "contact", Type::kCount, kAnyCount},
    {"work/rows", "friction", Type::kCount, kAnyCount},
    {"work/criterion", "evaluations", Type::kCount, kAnyCount},
    {"work/criterion", "flops", Type::kCount, kAnyCount},
    {"timing", "ms_median", Type::kNumber, kNotNegative},
    {"timing", "ms_p95", Type::kNumber, kNotNegative},
    {"timing", "real_time_factor", Type::kNumber, kNotNegative},
    {"timing", "stages", Type::kObject},
    {"timing/stages", "joints", Type::kNumber, kNotNegative},
    {"timing/stages", "contact", Type::kNumber, kNotNegative},
    {"timing/stages", "friction", Type::kNumber, kNotNegative},
    {"timing/stages", "mass", Type::kNumber, kNotNegative},
    {"timing/stages", "solve", Type::kNumber, kNotNegative},
    {"timing/stages", "stiffness", Type::kNumber, kNotNegative},
    {"timing/stages", "integrate", Type::kNumber, kNotNegative},
    {"timing/stages", "total", Type::kNumber, kNotNegative},
};

constexpr std::size_t kLongestText = 4 * kMaxProse;  // [bytes]

bool is_hash(const std::string& text) {
  constexpr std::size_t kDigits = 16;
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Checks one field of an object. @param failed whether the run of this result failed
void check(const Field& field, bool failed, ObjectReader& in) {
  const Json* value = in.member(field.name, field.presence);
  if (!value) return;
  const bool may_be_null =
      field.type == Type::kOfReference || (field.type == Type::kError && failed);
  if (may_be_null && value->is_null()) return;
  double number = 0.0;
  std::string text;
  bool flag = false;
  switch (field.type) {
    case Type::kObject:
      if (!value->is_object()) in.problem(field.name, must_be("an object", value_text(*value)));
      break;
    case Type::kText:
      in.text(field.name, kLongestText, text, kOptional);
      break;
    case Type::kHash:
      if (in.text(field.name, kLongestText, text, kOptional) && !is_hash(text)) {
        in.problem(field.name, must_be("16 hexadecimal digits", value_text(*value)));
      }
      break;
    case Type::kFlag:
      in.flag(field.name, flag, kOptional);
      break;
    case Type::kNumber:
    case Type::kError:
    case Type::kOfReference:
      in.number(field.name, field.range, number, kOptional);
      break;
    case Type::kCount:
      number = value->is_number() ? value->get<double>() : std::nan("");
      if (!field.range.contains(number) || number != std::floor(number)) {
        in.problem(field.name, must_be("a whole number " + field.range.text(), value_text(*value)));
      }
      break;
  }
}

/// Checks all fields by the table.
void check_fields(const Json& line, Problems& problems) {
  const bool failed = line.is_object() && line.contains("holds") && line["holds"] == false;
  const auto check_part = [&](std::string_view part, const Json& json) {
    ObjectReader in(json, part.empty() ? "" : '/' + std::string(part), problems);
    for (const Field& field : kResultFields) {
      if (field.part == part) check(field, failed, in);
    }
    in.finish();
  };
  check_part("", line);
  if (!problems.empty()) return;
  for (const Field& field : kResultFields) {
    if (field.type != Type::kObject || field.name == "settings") continue;
    std::string path(field.part);
    path += (path.empty() ? "" : "/") + std::string(field.name);
    const Json::json_pointer at('/' + path);
    if (line.contains(at) && line.at(at).is_object()) check_part(path, line.at(at));
  }
}

std::uint64_t hash_of(const std::string& digits) {
  constexpr int kHexadecimal = 16;
  std::uint64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, kHexadecimal);
  return value;
}

}  // namespace

std::optional<Experiment> read_result(const Json& line, Problems& problems) {
  Problems found;
  check_fields(line, found);
  Experiment experiment;
  if (found.empty()) {
    ObjectReader in(line, "", found);
    in.text("scene", kMaxNameSize, experiment.scene, kRequired);
    experiment.scene_hash = hash_of(line["scene_hash"].get<std::string>());
    experiment.settings = kPaperSettings;  // the program wrote all settings that there were then
    read_settings(in, experiment.settings, found);
    experiment.duration = line["seconds"].get<double>();
    experiment.load = line["load"].get<double>();
    experiment.seed = line["seed"].get<int>();
  }
  if (found.empty()) check_result_agreement(line, experiment, found);
  problems.insert(problems.end(), found.begin(), found.end());
  return found.empty() ? std::optional(std::move(experiment)) : std::nullopt;
}

}  // namespace substep
