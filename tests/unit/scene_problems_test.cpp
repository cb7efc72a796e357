// Bad scene files: every problem is named with its pointer, the value and what is allowed.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/unit/scene_text.hpp"

namespace substep {
namespace {

using test::List;
using test::problems_of;
using test::with;

struct BadFile {
  const char* kind;
  std::string passage;
  std::string replacement;
  List problems;
};

// Printed by GoogleTest in place of the bytes.
void PrintTo(const BadFile& file, std::ostream* out) { *out << file.kind; }

class BadScene : public testing::TestWithParam<BadFile> {};

TEST_P(BadScene, NamesPlaceValueAndRange) {
  const BadFile& file = GetParam();
  EXPECT_EQ(problems_of(with(file.passage, file.replacement)), file.problems);
}

std::string kind_of(const testing::TestParamInfo<BadFile>& file) { return file.param.kind; }

INSTANTIATE_TEST_SUITE_P(
    Numbers, BadScene,
    testing::Values(
        BadFile{"NegativeMass",
                R"("mass": 2)",
                R"("mass": -1)",
                {"/bodies/1/mass: -1 is not > 0 (kg)"}},
        BadFile{
            "ZeroMass", R"("mass": 2)", R"("mass": 0.0)", {"/bodies/1/mass: 0 is not > 0 (kg)"}},
        BadFile{"HugeMass",
                R"("mass": 2)",
                R"("mass": 1e13)",
                {"/bodies/1/mass: 1e13 is not <= 1e12 (kg)"}},
        BadFile{"MassAsText",
                R"("mass": 2)",
                R"("mass": "2")",
                {"/bodies/1/mass: \"2\" is not a number (kg)"}},
        BadFile{"MassMissing", R"("mass": 2,)", "", {"/bodies/1/mass: missing"}},
        BadFile{"NumberBeyondRange",
                R"("mass": 2)",
                R"("mass": 1e999)",
                {"/bodies/1/mass: 1e999 is beyond the range of numbers (1.8e308)"}},
        BadFile{"ItemBeyondRange",
                R"("velocity": [0, 0, 0])",
                R"("velocity": [0, -1e400, 0])",
                {"/bodies/1/velocity/1: -1e400 is beyond the range of numbers (1.8e308)"}},
        BadFile{"Null",
                R"("mass": 2)",
                R"("mass": null)",
                {"/bodies/1/mass: null is not a number (kg)"}},
        BadFile{"ZeroInertia",
                "[0.1, 0.2, 0.2]",
                "[0, 0.2, 0.2]",
                {"/bodies/1/inertia/0: 0 is not > 0 (kg m^2)"}},
        BadFile{
            "InertiaOfNoBody",
            "[0.1, 0.2, 0.2]",
            "[0.25, 0.25, 0.75]",
            {"/bodies/1/inertia: no body has these moments: 0.75 is not <= the sum of the other "
             "two, 0.5 (kg m^2)"}},
        BadFile{"InertiaUnderflow",
                R"("radius": 0.5}, "mass": 1)",
                R"("radius": 1e-200}, "mass": 1)",
                {"/bodies/2/inertia: mass and shape are so small that their inertia is 0"}},
        BadFile{"ZeroRadius",
                R"("radius": 0.5)",
                R"("radius": 0)",
                {"/bodies/2/shape/radius: 0 is not > 0 (m)"}},
        BadFile{"NegativeSize",
                "[1, 0.1, 0.1]",
                "[1, -0.1, 0.1]",
                {"/bodies/1/shape/size/1: -0.1 is not > 0 (m)"}},
        BadFile{"TwoNumbers",
                R"("position": [0, 3, 0])",
                R"("position": [0, 3])",
                {"/bodies/1/position: [0,3] is not a list of 3 numbers (m)"}},
        BadFile{"PositionTooFar",
                R"("position": [0, 0, 0])",
                R"("position": [0, 2e6, 0])",
                {"/bodies/0/position/1: 2e6 is not <= 1e6 (m)"}},
        BadFile{"VelocityTooHigh",
                R"("velocity": [0, 0, 0])",
                R"("velocity": [0, -1e6, 0])",
                {"/bodies/1/velocity/1: -1e6 is not >= -100000 (m/s)"}},
        BadFile{"NegativeFriction",
                R"("friction": 0.5)",
                R"("friction": -0.5)",
                {"/bodies/1/friction: -0.5 is not >= 0"}},
        BadFile{"NegativeCompliance",
                R"("compliance": 1e-8)",
                R"("compliance": -1e-8)",
                {"/joints/1/compliance: -1e-8 is not >= 0 (m/N)"}},
        BadFile{
            "OrientationTooLong",
            "[1, 0, 0, 0]",
            "[1, 1, 0, 0]",
            {"/bodies/1/orientation: length 1.4142135623730951 is not 1 within 1e-6; at length 1 "
             "it is [0.7071067811865475, 0.7071067811865475, 0, 0]"}},
        BadFile{"OrientationZero",
                "[1, 0, 0, 0]",
                "[0, 0, 0, 0]",
                {"/bodies/1/orientation: length 0 is not 1 within 1e-6"}},
        BadFile{"AxisTooShort",
                R"("axis_b": [0, 0, 1])",
                R"("axis_b": [0, 0, 0.5])",
                {"/joints/0/axis_b: length 0.5 is not 1 within 1e-6"}},
        BadFile{"FrameZero", R"("frame": 0.01)", R"("frame": 0)", {"/frame: 0 is not >= 1e-5 (s)"}},
        BadFile{"CollisionGroupFraction",
                R"("friction": 0.5)",
                R"("collision_group": 0.5)",
                {"/bodies/1/collision_group: 0.5 is not a whole number from 0 to 1000000"}},
        BadFile{"CameraInItself",
                R"("frame": 0.01)",
                R"("camera": {"eye": [1, 2, 3], "target": [1, 2, 3]})",
                {"/camera/target: the same point as eye"}}),
    kind_of);

INSTANTIATE_TEST_SUITE_P(
    Names, BadScene,
    testing::Values(
        BadFile{"UnknownKeyCloseToOne",
                R"("mass": 2)",
                R"("mass": 2, "frcition": 1)",
                {"/bodies/1/frcition: unknown key (did you mean \"friction\"?)"}},
        BadFile{"UnknownKeyOfShape",
                R"("type": "plane")",
                R"("type": "plane", "colour": 3)",
                {"/bodies/0/shape/colour: unknown key (known here: type)"}},
        BadFile{
            "UnknownKeyOfBallJoint",
            R"("compliance": 1e-8)",
            R"("compliance": 1e-8, "angular_compliance": 0)",
            {"/joints/1/angular_compliance: unknown key (known here: name, type, a, b, anchor_a, "
             "anchor_b or compliance)"}},
        BadFile{"KeyTwice",
                R"("mass": 2)",
                R"("mass": 2, "mass": 3)",
                {"/bodies/1/mass: the key stands twice in this object"}},
        BadFile{"KeyWithSlash",
                R"("mass": 2)",
                R"("mass": 2, "a/b~c": 3)",
                {"/bodies/1/a~1b~0c: unknown key (known here: name, static, shape, mass, inertia, "
                 "position, orientation, velocity, angular_velocity, friction, collision_group or "
                 "collides)"}},
        BadFile{"BodyNameTwice",
                R"("name": "ball", "shape")",
                R"("name": "floor", "shape")",
                {"/bodies/2/name: \"floor\" is the name of /bodies/0 already",
                 "/joints/1/a: no body is named \"ball\""}},
        BadFile{"BodyNamedWorld",
                R"("name": "floor")",
                R"("name": "world")",
                {"/bodies/0/name: \"world\" is not a name for a body: it is the fixed world"}},
        BadFile{"BodyNameEmpty",
                R"("name": "floor")",
                R"("name": "")",
                {"/bodies/0/name: \"\" is empty"}},
        BadFile{"ControlCharacter",
                R"("name": "floor")",
                R"("name": "flo\u0007or")",
                {"/bodies/0/name: \"flo\\u0007or\" has a control character"}},
        BadFile{"JointNameTwice",
                R"("name": "socket")",
                R"("name": "hinge")",
                {"/joints/1/name: \"hinge\" is the name of /joints/0 already"}},
        BadFile{"DanglingBody",
                R"("b": "arm")",
                R"("b": "arn")",
                {"/joints/1/b: no body is named \"arn\" (did you mean \"arm\"?)"}},
        BadFile{"DanglingTrack",
                R"("track": "arm")",
                R"("track": "leg")",
                {"/criteria/track: no body is named \"leg\""}},
        BadFile{"TrackWorld",
                R"("track": "arm")",
                R"("track": "world")",
                {"/criteria/track: \"world\" is not a body"}},
        BadFile{"DanglingDisplacement",
                R"("track": "arm")",
                R"("displacement": {"body": "lid", "distance": 1})",
                {"/criteria/displacement/body: no body is named \"lid\""}},
        BadFile{"SceneNameWithSpace",
                R"("name": "good")",
                R"("name": "very good")",
                {"/name: \"very good\" is not made of a-z, 0-9, _ and - only"}},
        BadFile{"TitleMissing", R"("title": "Good",)", "", {"/title: missing"}},
        BadFile{"ShapeOfNoKind",
                R"("type": "sphere")",
                R"("type": "cylinder")",
                {"/bodies/2/shape/type: \"cylinder\" is not sphere, box or plane"}},
        BadFile{"JointOfNoKind",
                R"("type": "hinge")",
                R"("type": "slider")",
                {"/joints/0/type: \"slider\" is not ball or hinge"}},
        BadFile{
            "EffectOfNoKind",
            R"("friction"],)",
            R"("friction", "magnetism"],)",
            {"/effects/4: \"magnetism\" is not gravity, gyroscopic, joints, contact or friction"}},
        BadFile{"EffectTwice",
                R"("friction"],)",
                R"("friction", "gravity"],)",
                {"/effects/4: \"gravity\" stands twice"}},
        BadFile{"VerdictOfNoKind",
                R"("track": "arm")",
                R"("expected": "maybe")",
                {"/criteria/expected: \"maybe\" is not holds or fails"}},
        BadFile{"BodiesNoList",
                R"("joints": [)",
                R"("joints": 3, "x": [)",
                {"/joints: 3 is not a list",
                 "/x: unknown key (known here: format, version, name, title, group, description, "
                 "look_for, camera, frame, effects, gravity, contact, regularisation, settings, "
                 "bodies, criteria or joints)"}},
        BadFile{"BodyNoObject",
                R"("bodies": [)",
                R"("bodies": [7, )",
                {"/bodies/0: 7 is not an object"}}),
    kind_of);

INSTANTIATE_TEST_SUITE_P(
    Settings, BadScene,
    testing::Values(BadFile{"AlphaTooLarge",
                            R"("alpha": 0.1)",
                            R"("alpha": 2)",
                            {"/settings/alpha: 2 is not > 0 and <= 1"}},
                    BadFile{"SolverOfNoKind",
                            R"("solver": "bpp")",
                            R"("solver": "xpbd")",
                            {"/settings/solver: \"xpbd\" is not pgs or bpp"}},
                    BadFile{"CountZero",
                            R"("n": 16)",
                            R"("n": 0)",
                            {"/settings/n: 0 is not a whole number from 1 to 10000"}},
                    BadFile{"CountFraction",
                            R"("n": 16)",
                            R"("n": 2.5)",
                            {"/settings/n: 2.5 is not a whole number from 1 to 10000"}},
                    BadFile{"CountAsText",
                            R"("n": 16)",
                            R"("n": "16")",
                            {"/settings/n: \"16\" is not a whole number from 1 to 10000"}},
                    BadFile{"FlagAsNumber",
                            R"("probe": true)",
                            R"("probe": 1)",
                            {"/settings/probe: 1 is not true or false"}},
                    BadFile{"MemoryOne",
                            R"("n": 16)",
                            R"("memory": 1)",
                            {"/settings/memory: 1 is not >= 0 and < 1"}},
                    BadFile{"UnknownSetting",
                            R"("alpha": 0.1)",
                            R"("alhpa": 0.1)",
                            {"/settings/alhpa: unknown key (did you mean \"alpha\"?)"}}),
    kind_of);

INSTANTIATE_TEST_SUITE_P(
    Meaning, BadScene,
    testing::Values(
        BadFile{"PlaneThatMoves",
                R"("name": "floor", "static": true)",
                R"("name": "floor", "mass": 1)",
                {"/bodies/0/shape/type: a plane cannot move: its body needs \"static\": true"}},
        BadFile{"StaticBodyWithMass",
                R"("static": true)",
                R"("static": true, "mass": 1)",
                {"/bodies/0/mass: a static body has no mass"}},
        BadFile{"StaticBodyWithVelocity",
                R"("static": true)",
                R"("static": true, "velocity": [1, 0, 0])",
                {"/bodies/0/velocity: a static body never moves"}},
        BadFile{"JointToItself",
                R"("b": "arm")",
                R"("b": "ball")",
                {"/joints/1/b: the same body as a"}},
        BadFile{"JointFromStaticBody",
                R"("a": "ball")",
                R"("a": "floor")",
                {"/joints/1/a: this body is static: a must move, b may be static or \"world\""}},
        BadFile{"JointFromWorld",
                R"("a": "ball")",
                R"("a": "world")",
                {"/joints/1/a: \"world\" never moves: a must move, b may be static or \"world\""}},
        BadFile{"AnchorsApart",
                "\"anchor_b\": [0.5, 0, 0]",
                "\"anchor_b\": [0.5, 0, 0.25]",
                {"/joints/1: the anchors start 0.25 apart, which is not <= 0.1 (m)"}},
        BadFile{"AxesApart",
                R"("axis_b": [0, 0, 1])",
                R"("axis_b": [0, 1, 0])",
                {"/joints/0: the axes start at an angle with sine 1, which is not <= 0.1"}},
        BadFile{
            "AxesOpposite",
            R"("axis_b": [0, 0, 1])",
            R"("axis_b": [0, 0, -1])",
            {"/joints/0: the axes start at an angle with sine 0 in opposite directions, which is "
             "not <= 0.1"}},
        BadFile{
            "RedundantRows",
            R"("b": "arm", "anchor_a": [-0.5, 0, 0],
     "anchor_b": [0.5, 0, 0], "compliance": 1e-8)",
            R"("b": "arm", "anchor_a": [-0.5, 0, 0], "anchor_b": [0.5, 0, 0]},
    {"name": "twin", "type": "ball", "a": "arm", "b": "ball", "anchor_a": [0.5, 0, 0.1],
     "anchor_b": [-0.5, 0, 0.1])",
            {"/joints/2/compliance: 0 here and in \"socket\" between the same bodies: \"socket\" "
             "and \"twin\" hold the same twice, so one of them must be > 0 (m/N)"}},
        BadFile{
            "StiffContact",
            R"("compliance": 1e-9)",
            R"("compliance": 0)",
            {"/contact/compliance: 0 is not > 0 (m/N): a box that lies on its face has redundant "
             "contacts"}},
        BadFile{
            "StiffFriction",
            R"("compliance": 1e-9)",
            R"("friction_compliance": 0)",
            {"/contact/friction_compliance: 0 is not > 0 (m/N): a box that lies on its face has "
             "redundant contacts"}},
        BadFile{"JointsNotListed",
                R"("gravity", "joints")",
                R"("gravity")",
                {"/effects: \"joints\" is missing, and /joints has 2"}},
        BadFile{"GravityNotListed",
                R"("gravity", "joints")",
                R"("joints")",
                {"/effects: \"gravity\" is missing, and /gravity is given"}},
        BadFile{"FrictionNotListed",
                R"(, "friction"])",
                "]",
                {"/effects: \"friction\" is missing, and /bodies/1/friction is 0.5"}},
        BadFile{"ContactNotListed",
                R"("contact", "friction"])",
                R"("friction"])",
                {"/effects: \"contact\" is missing, and /contact is given",
                 "/effects: \"contact\" is missing, and \"friction\" needs it"}},
        BadFile{"OtherVersion",
                R"("version": 1)",
                R"("version": 2)",
                {"/version: 2 is not 1, the only version that is known"}},
        BadFile{"OtherFormat",
                R"("substep-scene")",
                R"("gltf")",
                {"/format: \"gltf\" is not \"substep-scene\""}}),
    kind_of);

}  // namespace
}  // namespace substep
