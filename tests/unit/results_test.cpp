// Results as lines of text.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <memory>
#include <set>

#include "core/io/experiment.hpp"
#include "core/io/result.hpp"
#include "core/io/result_reader.hpp"
#include "core/lab/sweep.hpp"
#include "core/model/setting_fields.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/scene_schema_validator.hpp"
#include "tests/unit/unusual_settings.hpp"

namespace substep::test {
namespace {

Json result_schema() {
  std::ifstream file(SUBSTEP_SOURCE_DIR "/core/io/result.schema.json");
  return Json::parse(file, nullptr, false);
}

TEST(Results, LinesConformToTheirSchema) {
  const Json schema = result_schema();
  ASSERT_TRUE(schema.is_object());
  EXPECT_EQ(schema_errors(schema, schema, Json::parse(results_header())),
            std::vector<std::string>{});
  Settings none;
  none.mode = Mode::kNone;
  for (const auto& [scene, settings] :
       {std::pair{scenes::swinging_box(), Settings{}}, std::pair{scenes::swinging_box(), none},
        std::pair{scenes::heavy_stack(), Settings{}}, std::pair{scenes::spinning_top(), Settings{}},
        std::pair{scenes::sliding_box(), unusual()}}) {
    Experiment experiment = experiment_of(scene, settings);
    experiment.duration = 0.5;
    const Reference reference = find_reference(std::make_shared<const Scene>(scene), 0.1);
    ExperimentRun run(scene, experiment, reference);
    while (run.advance()) {
    }
    Json line = Json::parse(result_json(run.result()).dump());
    EXPECT_EQ(schema_errors(schema, schema, line), std::vector<std::string>{}) << line.dump();
    line["colour"] = "red";
    EXPECT_FALSE(schema_errors(schema, schema, line).empty());
  }
}

/// The line of a run of half a second.
Json line_of(const Scene& scene, const Settings& settings) {
  Experiment experiment = experiment_of(scene, settings);
  experiment.duration = 0.5;
  const Reference reference = find_reference(std::make_shared<const Scene>(scene), 0.1);
  ExperimentRun run(scene, experiment, reference);
  while (run.advance()) {
  }
  return Json::parse(result_json(run.result()).dump());
}

std::size_t problems_of(const Json& line) {
  Problems problems;
  const bool read = read_result(line, problems).has_value();
  EXPECT_EQ(read, problems.empty());
  return problems.size();
}

/// Pointers to all values of a line, objects too.
std::vector<Json::json_pointer> places_in(const Json& json, const Json::json_pointer& here) {
  std::vector<Json::json_pointer> all;
  for (const auto& item : json.items()) {
    all.push_back(here / item.key());
    if (!item.value().is_object()) continue;
    const auto inner = places_in(item.value(), all.back());
    all.insert(all.end(), inner.begin(), inner.end());
  }
  return all;
}

TEST(Results, ForgedFieldsAreRefused) {
  const Json schema = result_schema();
  Settings none;
  none.mode = Mode::kNone;
  int forgeries = 0;
  for (const Json& line :
       {line_of(scenes::swinging_box(), Settings{}), line_of(scenes::swinging_box(), none),
        line_of(scenes::heavy_stack(), Settings{})}) {
    ASSERT_EQ(problems_of(line), 0U);
    for (const Json::json_pointer& place : places_in(line, Json::json_pointer())) {
      const std::string pointer = place.to_string();
      const std::string top = pointer.substr(1, pointer.find('/', 1) - 1);
      // All of these determine the id, or follow from the settings.
      const bool bound = Json({"id", "scene", "scene_hash", "settings", "seconds", "load", "seed",
                               "series", "parameter", "holds"})
                             .get<std::set<std::string>>()
                             .contains(top);
      for (const Json& value : {Json("x"), Json(-1), Json(-1.5), Json(1.5), Json(1e300), Json(true),
                                Json(false), Json(nullptr), Json::array(), Json::object()}) {
        if (value == line.at(place)) continue;
        if (pointer == "/settings" && value.is_object()) continue;  // the paper's
        Json forged = line;
        forged[place] = value;
        if (!bound && schema_errors(schema, schema, forged).empty()) continue;
        EXPECT_GT(problems_of(forged), 0U) << pointer << ": " << value.dump();
        ++forgeries;
      }
      Json forged = line;
      forged.at(place.parent_pointer()).erase(place.back());
      if (!schema_errors(schema, schema, forged).empty()) {
        EXPECT_GT(problems_of(forged), 0U) << "without " << pointer;
      }
      if (!line.at(place).is_object()) continue;
      forged = line;
      forged[place / "colour"] = "red";
      EXPECT_GT(problems_of(forged), 0U) << pointer;
    }
  }
  EXPECT_GT(forgeries, 1000);
}

TEST(Results, AWholeNumberMayHaveADecimalPoint) {
  Json line = line_of(scenes::heavy_stack(), Settings{});
  line["seed"] = 0.0;
  line["work"]["frames"] = 30.0;
  EXPECT_EQ(problems_of(line), 0U);
  line["work"]["frames"] = 29.5;
  EXPECT_EQ(problems_of(line), 1U);
}

TEST(Results, FieldsThatContradictEachOtherAreRefused) {
  Settings none;
  none.mode = Mode::kNone;
  const Json held = line_of(scenes::heavy_stack(), Settings{});
  const Json failed = line_of(scenes::swinging_box(), none);
  struct Forgery {
    const Json& line;
    const char* part;
    const char* name;
    Json value;
    const char* problem;  // the name of its field
  };
  for (const Forgery& of : std::initializer_list<Forgery>{
           {held, "", "seconds", 86401.0, "seconds"},
           {held, "", "verdict", "fails at 0.100 s: a joint opens", "verdict"},
           {held, "", "failed_at", 0.1, "failed_at"},
           {held, "", "holds", false, "failed_at"},
           {held, "work", "frames", 0, "substeps"},
           {held, "work", "frames", 1000000, "frames"},
           {held, "work", "frames", 31, "substeps"},
           {held, "work", "substeps", 29, "substeps"},
           {held, "work", "n_max", 1000, "substeps"},
           {held, "work", "n_median", 100000, "n_median"},
           {held, "errors", "energy_drift", -1e9, "energy_drift"},
           {held, "errors/penetration", "median", 1.0, "median"},
           {held, "timing", "ms_median", 1e9, "ms_median"},
           {failed, "", "failed_at", 1e9, "verdict"},
           {failed, "", "failed_at", 0.0, "verdict"},
           {failed, "", "verdict", "holds", "verdict"},
           {failed, "", "verdict", "torn", "verdict"},
           {failed, "work", "frames", 0, "substeps"}}) {
    ASSERT_EQ(problems_of(of.line), 0U);
    Json forged = of.line;
    Json::json_pointer place;
    if (*of.part != '\0') place = Json::json_pointer(std::string("/") + of.part);
    forged[place / of.name] = of.value;
    Problems problems;
    read_result(forged, problems);
    ASSERT_FALSE(problems.empty()) << of.name << ": " << of.value;
    EXPECT_TRUE(std::any_of(
        problems.begin(), problems.end(),
        [&](const Problem& p) { return p.pointer.ends_with(std::string("/") + of.problem); }))
        << of.name << ": " << problems.front().pointer << " " << problems.front().message;
  }
  // A failure after the run has ended, with a verdict to match.
  Json late = failed;
  late["failed_at"] = 1000.0;
  late["verdict"] = "fails at 1000.000 s: a joint opens";
  EXPECT_EQ(problems_of(late), 1U);
}

TEST(Results, AnErrorThatIsNotFiniteIsNullInAFailedRunOnly) {
  Settings none;
  none.mode = Mode::kNone;
  Json failed = line_of(scenes::swinging_box(), none);
  ASSERT_FALSE(failed["holds"]);
  failed["errors"]["energy_drift_peak"] = nullptr;
  EXPECT_EQ(problems_of(failed), 0U);
  Json held = line_of(scenes::swinging_box(), Settings{});
  held["errors"]["energy_drift_peak"] = nullptr;
  EXPECT_EQ(problems_of(held), 1U);
}

TEST(Results, WhatIsNotFiniteOfAReferenceIsReadAgain) {
  const Scene scene = scenes::swinging_box();
  Experiment experiment = experiment_of(scene, Settings{});
  experiment.duration = 0.1;
  Reference reference = find_reference(std::make_shared<const Scene>(scene), 0.1);
  reference.uncertainty = std::numeric_limits<double>::infinity();
  reference.energy_scale = std::numeric_limits<double>::infinity();
  ExperimentRun run(scene, experiment, reference);
  while (run.advance()) {
  }
  const Json line = Json::parse(result_json(run.result()).dump());
  EXPECT_TRUE(line["reference"]["uncertainty"].is_null());
  EXPECT_TRUE(line["reference"]["energy_scale"].is_null());
  EXPECT_EQ(problems_of(line), 0U);
  const Json schema = result_schema();
  EXPECT_EQ(schema_errors(schema, schema, line), std::vector<std::string>{});
}

// The command line refuses them.
TEST(Results, SweptSettingsOfTheSceneHaveNoEffectOnASweepAndTheOthersHave) {
  const auto swept = swept_settings();
  for (const SettingField& field : setting_fields()) {
    bool acts = false;
    for (Scene scene : {scenes::swinging_box(), scenes::heavy_stack(), scenes::spinning_top()}) {
      scene.settings = Settings{};
      scene.recommended.reset();
      const std::vector<SweepPoint> plain = default_sweep(scene);
      const std::string now = setting_text(field, scene.settings);
      for (const char* value :
           {"true",    "false",  "1",        "3",        "0.25",     "1e-5", "pgs",      "bpp",
            "xpbd",    "newton", "end",      "mean",     "const",    "none", "adaptive", "frame",
            "substep", "euler",  "leapfrog", "implicit", "explicit", "auto", "soft",     "full",
            "paper",   "exact",  "box",      "pyramid",  "cone"}) {
        Scene other = scene;
        if (value == now || set_setting(field, value, other.settings)) continue;
        const std::vector<SweepPoint> points = default_sweep(other);
        acts = acts || points.size() != plain.size() ||
               !std::equal(points.begin(), points.end(), plain.begin(),
                           [](const SweepPoint& a, const SweepPoint& b) {
                             return a.settings == b.settings && a.load == b.load;
                           });
      }
    }
    const bool is_swept = std::find(swept.begin(), swept.end(), field.name) != swept.end();
    // N is read by the modes that a sweep gives their own N only.
    EXPECT_TRUE(acts != is_swept || field.name == "n") << field.name;
  }
}

TEST(Results, HeadersOfOtherFilesAreRefused) {
  Problems problems;
  std::string own = results_header();
  own.pop_back();
  check_results_header(own, problems);
  EXPECT_TRUE(problems.empty());
  for (const char* foreign : {"", "{}", "frame,time", R"({"format":"substep-scene","version":1})",
                              R"({"format":"substep-results","version":2})"}) {
    problems.clear();
    check_results_header(foreign, problems);
    EXPECT_FALSE(problems.empty()) << foreign;
  }
}

}  // namespace
}  // namespace substep::test
