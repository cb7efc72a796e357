// Results as lines of text.

#include <gtest/gtest.h>

#include <fstream>

#include "core/io/experiment.hpp"
#include "core/io/result.hpp"
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
