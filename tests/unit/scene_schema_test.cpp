// The schema of the scenes agrees with the reader, key for key.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "core/io/json.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/setting_fields.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/unit/scene_schema_validator.hpp"

namespace substep {
namespace {

const Json& schema() {
  static const Json json = [] {
    std::ifstream file(SUBSTEP_SOURCE_DIR "/scenes/scene.schema.json");
    return Json::parse(std::string(std::istreambuf_iterator<char>(file), {}), nullptr, false);
  }();
  return json;
}

/// Calls `visit(pointer, object schema)` for every schema that has properties.
template <class Visit>
void for_each_object(const Json& part, const std::string& pointer, Visit visit) {
  if (part.is_object() && part.contains("properties")) visit(pointer, part);
  if (!part.is_structured()) return;
  for (const auto& item : part.items()) {
    for_each_object(item.value(), pointer + "/" + item.key(), visit);
  }
}

std::set<std::string> keys(const Json& object) {
  std::set<std::string> result;
  for (const auto& item : object.items()) result.insert(item.key());
  return result;
}

/// The keys that the reader accepts at the pointer, from its message about an unknown key.
std::set<std::string> known_to_reader(const Json& scene, const std::string& pointer) {
  const std::string key = "no such key";
  Json edited = scene;
  edited[Json::json_pointer(pointer)][key] = 1;
  for (const Problem& problem : read_scene(edited.dump()).problems) {
    if (problem.pointer != pointer + "/" + key) continue;
    std::string list = problem.message.substr(problem.message.find("known here: ") + 12);
    list.pop_back();
    std::set<std::string> known;
    const std::regex word("[a-z_]+");
    for (auto it = std::sregex_iterator(list.begin(), list.end(), word);
         it != std::sregex_iterator(); ++it) {
      if (it->str() != "or") known.insert(it->str());
    }
    return known;
  }
  ADD_FAILURE() << "the reader takes an unknown key in " << pointer;
  return {};
}

TEST(SceneSchema, IsJson) { EXPECT_TRUE(schema().is_object()); }

TEST(SceneSchema, EveryKeyHasADescriptionAndEveryNumberAUnit) {
  int seen = 0;
  for_each_object(schema(), "", [&](const std::string& pointer, const Json& object) {
    EXPECT_EQ(object["additionalProperties"], Json(false)) << pointer;
    for (const auto& item : object["properties"].items()) {
      ++seen;
      const std::string where = pointer + "/" + item.key();
      const Json& property = item.value();
      ASSERT_TRUE(property.contains("description")) << where;
      const bool is_number = property.value("type", "") == "number" ||
                             property.value("type", "") == "integer" ||
                             (property.contains("items") && property["items"].contains("minimum"));
      if (!is_number) continue;
      const auto text = property["description"].get<std::string>();
      EXPECT_NE(text.find('['), std::string::npos) << where << " has no [unit]";
    }
  });
  EXPECT_GT(seen, 70);
}

TEST(SceneSchema, HasTheKeysOfTheReader) {
  Scene scene = scenes::bridge();
  scene.criteria.displacement = Criteria::Displacement{1, 0.1};
  scene.verdicts = {Expectation{}};
  scene.recommended.emplace();
  scene.settings.n = 3;  // otherwise they are the recommended ones, and omitted
  scene.carried.emplace().forces.emplace_back();
  auto hinge = std::get<HingeJoint>(scenes::pendulum().joints[0]);
  hinge.limit.emplace();
  hinge.motor.emplace();
  hinge.drive.emplace();
  hinge.spring.emplace();
  hinge.friction = hinge.armature = 1.0;
  scene.joints.emplace_back(hinge);
  PrismaticJoint slide;
  slide.limit.emplace();
  slide.motor.emplace();
  slide.drive.emplace();
  slide.spring.emplace();
  slide.friction = slide.armature = 1.0;
  scene.joints.emplace_back(slide);
  scene.joints.emplace_back(WeldJoint{});
  scene.joints.emplace_back(DistanceJoint{});
  scene.joints.emplace_back(UniversalJoint{});
  CylindricalJoint cylinder;
  cylinder.limit.emplace();
  cylinder.motor.emplace();
  cylinder.drive.emplace();
  cylinder.spring.emplace();
  cylinder.friction = cylinder.armature = 1.0;
  scene.joints.emplace_back(cylinder);
  scene.joints.emplace_back(RopeJoint{});
  const Json json = Json::parse(write_scene(scene), nullptr, false);
  const auto joint = [last = scene.joints.size() - 1](std::size_t before) {
    return "/joints/" + std::to_string(last - before);
  };
  // The place in the scene that the schema describes.
  const std::map<std::string, std::string> places{
      {"", ""},
      {"/properties/camera", "/camera"},
      {"/properties/contact", "/contact"},
      {"/properties/settings", "/settings"},
      {"/properties/recommended", "/recommended"},
      {"/properties/criteria", "/criteria"},
      {"/properties/criteria/properties/displacement", "/criteria/displacement"},
      {"/properties/verdicts/items", "/verdicts/0"},
      {"/properties/carried", "/carried"},
      {"/properties/carried/properties/forces/items", "/carried/forces/0"},
      {"/$defs/body", "/bodies/1"},
      {"/$defs/shape/oneOf/0", "/bodies/21/shape"},
      {"/$defs/shape/oneOf/1", "/bodies/1/shape"},
      {"/$defs/shape/oneOf/2", "/bodies/0/shape"},
      {"/$defs/angle_limit", joint(6) + "/limit"},
      {"/$defs/angular_motor", joint(6) + "/motor"},
      {"/$defs/angular_drive", joint(6) + "/drive"},
      {"/$defs/angular_spring", joint(6) + "/spring"},
      {"/$defs/linear_spring", joint(5) + "/spring"},
      {"/$defs/travel_limit", joint(5) + "/limit"},
      {"/$defs/linear_motor", joint(5) + "/motor"},
      {"/$defs/linear_drive", joint(5) + "/drive"},
      {"/$defs/joint/oneOf/0", "/joints/0"},
      {"/$defs/joint/oneOf/1", joint(6)},
      {"/$defs/joint/oneOf/2", joint(5)},
      {"/$defs/joint/oneOf/3", joint(4)},
      {"/$defs/joint/oneOf/4", joint(3)},
      {"/$defs/joint/oneOf/5", joint(2)},
      {"/$defs/joint/oneOf/6", joint(1)},
      {"/$defs/joint/oneOf/7", joint(0)}};
  std::size_t seen = 0;
  for_each_object(schema(), "", [&](const std::string& pointer, const Json& object) {
    ++seen;
    const auto place = places.find(pointer);
    ASSERT_NE(place, places.end()) << pointer;
    EXPECT_EQ(known_to_reader(json, place->second), keys(object["properties"])) << pointer;
  });
  EXPECT_EQ(seen, places.size());
}

TEST(SceneSchema, SettingsHaveTheRangesAndDefaultsOfTheReader) {
  const Json& properties = schema()["properties"]["settings"]["properties"];
  for (const SettingField& field : setting_fields()) {
    const Json& property = properties[std::string(field.name)];
    const Json& value = property["default"];
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    EXPECT_EQ(text, setting_text(field, Settings{})) << field.name;
    if (const auto* count = std::get_if<CountSetting>(&field.member)) {
      EXPECT_EQ(property["minimum"], Json(count->least)) << field.name;
      EXPECT_EQ(property["maximum"], Json(count->most)) << field.name;
    } else if (const auto* number = std::get_if<NumberSetting>(&field.member)) {
      const Range& range = number->range;
      EXPECT_EQ(property[range.open_below ? "exclusiveMinimum" : "minimum"], Json(range.least));
      EXPECT_EQ(property[range.open_above ? "exclusiveMaximum" : "maximum"], Json(range.most));
    } else if (is_choice(field)) {
      std::string names;
      const Json& list = property["enum"];
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (i > 0) names += i + 1 == list.size() ? " or " : ", ";
        names += list[i].get<std::string>();
      }
      EXPECT_EQ(names, allowed_values(field));
    }
  }
}

TEST(SceneSchema, EveryShippedSceneConforms) {
  for (const Scene& scene : scenes::shipped()) {
    const Json json = Json::parse(write_scene(scene), nullptr, false);
    EXPECT_EQ(test::schema_errors(schema(), schema(), json), std::vector<std::string>{})
        << scene.name;
  }
}

TEST(SceneSchema, FindsWhatDoesNotConform) {
  const auto errors = [](const std::string& pointer, const Json& value) {
    Json json = Json::parse(write_scene(scenes::bridge()), nullptr, false);
    json[Json::json_pointer(pointer)] = value;
    return test::schema_errors(schema(), schema(), json).size();
  };
  EXPECT_EQ(errors("/frame", 0.5), 0U);
  EXPECT_GT(errors("/frame", 2), 0U);
  EXPECT_GT(errors("/colour", 2), 0U);
  EXPECT_GT(errors("/bodies/1/mass", 0), 0U);
  EXPECT_GT(errors("/bodies/1/shape/type", "cone"), 0U);
  EXPECT_GT(errors("/bodies/1/position", Json::array({1, 2})), 0U);
  EXPECT_GT(errors("/joints/0/compliance", "soft"), 0U);
  EXPECT_GT(errors("/settings/solver", "admm"), 0U);
  EXPECT_GT(errors("/effects/0", "magnetism"), 0U);
  EXPECT_GT(errors("/name", "Very Good"), 0U);
}

}  // namespace
}  // namespace substep
