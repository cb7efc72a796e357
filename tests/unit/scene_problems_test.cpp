// Invalid scene files: every problem is reported with its pointer, the value and the allowed range.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "core/io/scene_writer.hpp"
#include "core/model/scene_builder.hpp"
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

// GoogleTest prints this instead of the bytes.
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
                {"/bodies/1/mass: must be at least 1e-30 (kg), not -1"}},
        BadFile{"ZeroMass",
                R"("mass": 2)",
                R"("mass": 0.0)",
                {"/bodies/1/mass: must be at least 1e-30 (kg), not 0"}},
        BadFile{"HugeMass",
                R"("mass": 2)",
                R"("mass": 1e13)",
                {"/bodies/1/mass: must be at most 1e12 (kg), not 1e13"}},
        BadFile{"MassAsText",
                R"("mass": 2)",
                R"("mass": "2")",
                {"/bodies/1/mass: must be a number (kg), not \"2\""}},
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
                {"/bodies/1/mass: must be a number (kg), not null"}},
        BadFile{"ZeroInertia",
                "[0.1, 0.2, 0.2]",
                "[0, 0.2, 0.2]",
                {"/bodies/1/inertia/0: must be at least 1e-60 (kg m^2), not 0"}},
        BadFile{"InertiaOfNoBody",
                "[0.1, 0.2, 0.2]",
                "[0.25, 0.25, 0.75]",
                {"/bodies/1/inertia: no body has these moments: 0.75 is more than the sum of the "
                 "other two, 0.5 (kg m^2)"}},
        BadFile{
            "InertiaUnderflow",
            R"("radius": 0.5}, "mass": 1)",
            R"("radius": 1e-200}, "mass": 1)",
            {"/bodies/2/inertia: that of the mass and the shape must be at least 1e-60 (kg m^2), "
             "not 0"}},
        BadFile{"TinyMass",
                R"("mass": 2)",
                R"("mass": 1e-300)",
                {"/bodies/1/mass: must be at least 1e-30 (kg), not 1e-300"}},
        BadFile{"TinyInertia",
                "[0.1, 0.2, 0.2]",
                "[1e-300, 1e-300, 1e-300]",
                {"/bodies/1/inertia/0: must be at least 1e-60 (kg m^2), not 1e-300",
                 "/bodies/1/inertia/1: must be at least 1e-60 (kg m^2), not 1e-300",
                 "/bodies/1/inertia/2: must be at least 1e-60 (kg m^2), not 1e-300"}},
        BadFile{"ZeroRadius",
                R"("radius": 0.5)",
                R"("radius": 0)",
                {"/bodies/2/shape/radius: must be above 0 (m), not 0"}},
        BadFile{"NegativeSize",
                "[1, 0.1, 0.1]",
                "[1, -0.1, 0.1]",
                {"/bodies/1/shape/size/1: must be above 0 (m), not -0.1"}},
        BadFile{"TwoNumbers",
                R"("position": [0, 3, 0])",
                R"("position": [0, 3])",
                {"/bodies/1/position: must be a list of 3 numbers (m), not [0,3]"}},
        BadFile{"PositionTooFar",
                R"("position": [0, 0, 0])",
                R"("position": [0, 2e6, 0])",
                {"/bodies/0/position/1: must be at most 1e6 (m), not 2e6"}},
        BadFile{"VelocityTooHigh",
                R"("velocity": [0, 0, 0])",
                R"("velocity": [0, -1e9, 0])",
                {"/bodies/1/velocity/1: must be at least -1e8 (m/s), not -1e9"}},
        BadFile{"NegativeFriction",
                R"("friction": 0.5)",
                R"("friction": -0.5)",
                {"/bodies/1/friction: must be at least 0, not -0.5"}},
        BadFile{"NegativeCompliance",
                R"("compliance": 1e-8)",
                R"("compliance": -1e-8)",
                {"/joints/1/compliance: must be at least 0 (m/N), not -1e-8"}},
        BadFile{"OrientationTooLong",
                "[1, 0, 0, 0]",
                "[1, 1, 0, 0]",
                {"/bodies/1/orientation: must have length 1 within 1e-6, not 1.4142135623730951; "
                 "at length 1 "
                 "it is [0.7071067811865475, 0.7071067811865475, 0, 0]"}},
        BadFile{"OrientationZero",
                "[1, 0, 0, 0]",
                "[0, 0, 0, 0]",
                {"/bodies/1/orientation: must have length 1 within 1e-6, not 0"}},
        BadFile{"AxisTooShort",
                R"("axis_b": [0, 0, 1])",
                R"("axis_b": [0, 0, 0.5])",
                {"/joints/0/axis_b: must have length 1 within 1e-6, not 0.5"}},
        BadFile{"FrameZero",
                R"("frame": 0.01)",
                R"("frame": 0)",
                {"/frame: must be at least 1e-5 (s), not 0"}},
        BadFile{"CollisionGroupFraction",
                R"("friction": 0.5)",
                R"("collision_group": 0.5)",
                {"/bodies/1/collision_group: must be a whole number from 0 to 1000000, not 0.5"}},
        BadFile{"CameraInItself",
                R"("frame": 0.01)",
                R"("camera": {"eye": [1, 2, 3], "target": [1, 2, 3]})",
                {"/camera/target: must be a different point from eye"}}),
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
                {"/bodies/1/mass: the key occurs twice in this object"}},
        BadFile{"KeyWithSlash",
                R"("mass": 2)",
                R"("mass": 2, "a/b~c": 3)",
                {"/bodies/1/a~1b~0c: unknown key (known here: name, static, shape, mass, inertia, "
                 "position, orientation, velocity, angular_velocity, force, torque, "
                 "friction, restitution, "
                 "collision_group, collides or color)"}},
        BadFile{"BodyNameTwice",
                R"("name": "ball", "shape")",
                R"("name": "floor", "shape")",
                {"/bodies/2/name: \"floor\" is already the name of /bodies/0",
                 "/joints/1/a: no body is called \"ball\""}},
        BadFile{"BodyNamedWorld",
                R"("name": "floor")",
                R"("name": "world")",
                {"/bodies/0/name: must not be \"world\", the name of the fixed world"}},
        BadFile{"BodyNameEmpty",
                R"("name": "floor")",
                R"("name": "")",
                {"/bodies/0/name: must not be empty"}},
        BadFile{"ControlCharacter",
                R"("name": "floor")",
                R"("name": "flo\u0007or")",
                {"/bodies/0/name: \"flo\\u0007or\" has a control character (U+0007)"}},
        BadFile{"JointNameTwice",
                R"("name": "socket")",
                R"("name": "hinge")",
                {"/joints/1/name: \"hinge\" is already the name of /joints/0"}},
        BadFile{"DanglingBody",
                R"("b": "arm")",
                R"("b": "arn")",
                {"/joints/1/b: no body is called \"arn\" (did you mean \"arm\"?)"}},
        BadFile{"DanglingTrack",
                R"("track": "arm")",
                R"("track": "leg")",
                {"/criteria/track: no body is called \"leg\""}},
        BadFile{"TrackWorld",
                R"("track": "arm")",
                R"("track": "world")",
                {"/criteria/track: must be a body of the scene, not \"world\""}},
        BadFile{"NegativeWindow",
                R"("track": "arm")",
                R"("track": "arm", "window": -2)",
                {"/criteria/window: must be above 0 (s), not -2"}},
        BadFile{"DanglingDisplacement",
                R"("track": "arm")",
                R"("displacement": {"body": "lid", "distance": 1})",
                {"/criteria/displacement/body: no body is called \"lid\""}},
        BadFile{"SceneNameWithSpace",
                R"("name": "good")",
                R"("name": "very good")",
                {"/name: must be made of a-z, 0-9, _ and -, not \"very good\""}},
        BadFile{"TitleMissing", R"("title": "Good",)", "", {"/title: missing"}},
        BadFile{"ShapeOfNoKind",
                R"("type": "sphere")",
                R"("type": "cylinder")",
                {"/bodies/2/shape/type: must be sphere, box or plane, not \"cylinder\""}},
        BadFile{"JointOfNoKind",
                R"("type": "hinge")",
                R"("type": "slider")",
                {"/joints/0/type: must be ball, hinge, prismatic, weld, distance, universal, "
                 "cylindrical or rope, not \"slider\""}},
        BadFile{"EffectOfNoKind",
                R"("friction"],)",
                R"("friction", "magnetism"],)",
                {"/effects/4: must be gravity, gyroscopic, joints, contact, friction, restitution, "
                 "external, limits, motors, drives, joint_friction, armature or springs, not "
                 "\"magnetism\""}},
        BadFile{"EffectOfForcesMissing",
                R"("shape": {"type": "sphere")",
                R"("force": [0, 0, 0], "torque": [0, 1, 0], "shape": {"type": "sphere")",
                {"/effects: \"external\" is missing, but /bodies/2/torque is given"}},
        BadFile{"ForceOnAStaticBody",
                R"("shape": {"type": "plane")",
                R"("force": [1, 0, 0], "torque": [0, 0, 0], "shape": {"type": "plane")",
                {"/bodies/0/force: a static body never moves",
                 "/bodies/0/torque: a static body never moves"}},
        BadFile{"ForceBeyondRange",
                R"("shape": {"type": "sphere")",
                R"("force": [1e19, 0, 0], "torque": [0, null, 0], "shape": {"type": "sphere")",
                {"/bodies/2/force/0: must be at most 1e18 (N), not 1e19",
                 "/bodies/2/torque/1: must be a number (N m), not null"}},
        BadFile{"EffectTwice",
                R"("friction"],)",
                R"("friction", "gravity"],)",
                {"/effects/4: \"gravity\" is listed twice"}},
        BadFile{"VerdictOfNoKind",
                R"("track": "arm")",
                R"("expected": "maybe")",
                {"/criteria/expected: must be holds or fails, not \"maybe\""}},
        BadFile{"VerdictsNoList",
                R"("bodies": [)",
                R"("verdicts": "holds", "bodies": [)",
                {"/verdicts: must be a list, not \"holds\""}},
        BadFile{"VerdictRuleEmpty",
                R"("bodies": [)",
                R"("verdicts": [{}], "bodies": [)",
                {"/verdicts/0/verdict: missing"}},
        BadFile{"VerdictRuleOfNoKind",
                R"("bodies": [)",
                R"("verdicts": [{"verdict": "stands", "solver": "admm"}], "bodies": [)",
                {"/verdicts/0/solver: must be pgs, bpp, xpbd or newton, not \"admm\"",
                 "/verdicts/0/verdict: must be holds, fails or depends, not \"stands\""}},
        BadFile{"VerdictNumberWithoutConst",
                R"("bodies": [)",
                R"("verdicts": [{"verdict": "holds", "mode": "none", "n": 4}], "bodies": [)",
                {"/verdicts/0/n: is allowed in mode const only"}},
        BadFile{"VerdictTimeOfWhatHolds",
                R"("bodies": [)",
                R"("verdicts": [{"verdict": "holds", "before": 2}], "bodies": [)",
                {"/verdicts/0/before: is allowed with verdict fails only"}},
        BadFile{"VerdictTimeNegative",
                R"("bodies": [)",
                R"("verdicts": [{"verdict": "fails", "before": -2}], "bodies": [)",
                {"/verdicts/0/before: must be above 0 (s), not -2"}},
        BadFile{"VerdictDependsWithoutReason",
                R"("bodies": [)",
                R"("verdicts": [{"verdict": "depends"}], "bodies": [)",
                {"/verdicts/0/why: missing: depends needs a reason"}},
        BadFile{"CarriedLists",
                R"("bodies": [)",
                R"("carried": {"u": [], "k": 1, "forces": {}}, "bodies": [)",
                {"/carried/dt_previous: missing", "/carried/u: must be a list of 3 lists, not []",
                 "/carried/k: must be a list of 3 lists, not 1", "/carried/k: requires r",
                 "/carried/forces: must be a list of at most 1000000 items, not an object"}},
        BadFile{"CarriedIslands",
                R"("bodies": [)",
                R"("carried": {"dt_previous": 0.01, "own_r": [1]}, "bodies": [)",
                {"/carried/own_r: must be a list of 3 numbers (1/s^2), not [1]",
                 "/carried/own_r: own_r and own_dt_previous must be given together"}},
        BadFile{"CarriedHold",
                R"("bodies": [)",
                R"("carried": {"dt_previous": 0.01, "held_now": [1, 2, -3], "held_frames": -1},
                   "bodies": [)",
                {"/carried/held_now/2: must be at least 0 (1/s^2), not -3",
                 "/carried/held_now: held_now and held_before must be given together",
                 "/carried/held_frames: must be a whole number from 0 to 10000, not -1"}},
        BadFile{
            "CarriedForce",
            R"("bodies": [)",
            R"("carried": {"dt_previous": 2, "forces": [{"id": "xyz", "lambda": [1, 1e31],
                   "rate": 1, "rate_change": [1, 2, 3, 4, 5, 6, 7], "tight": "0~"}]}, "bodies": [)",
            {"/carried/dt_previous: must be at most 1 (s), not 2",
             R"(/carried/forces/0/id: must be a hexadecimal number of at most 16 digits, not "xyz")",
             "/carried/forces/0/lambda/1: must be at most 1e30 (N, N m), not 1e31",
             "/carried/forces/0/rate: must be a list of at most 6 numbers, not 1",
             "/carried/forces/0/rate_change: must be a list of at most 6 numbers, not "
             "[1,2,3,4,5,6,7]",
             R"(/carried/forces/0/tight: must be made of -, 0, + and ?, not "0~")"}},
        BadFile{
            "BodiesNoList",
            R"("joints": [)",
            R"("joints": 3, "x": [)",
            {"/joints: must be a list, not 3",
             "/x: unknown key (known here: format, version, name, title, group, description, "
             "look_for, camera, frame, effects, gravity, contact, regularisation, start, settings, "
             "recommended, "
             "bodies, criteria, verdicts, joints or carried)"}},
        BadFile{"BodyNoObject",
                R"("bodies": [)",
                R"("bodies": [7, )",
                {"/bodies/0: must be an object, not 7"}}),
    kind_of);

INSTANTIATE_TEST_SUITE_P(
    Settings, BadScene,
    testing::Values(BadFile{"AlphaTooLarge",
                            R"("alpha": 0.1)",
                            R"("alpha": 2)",
                            {"/settings/alpha: must be above 0 and at most 1, not 2"}},
                    BadFile{"SolverOfNoKind",
                            R"("solver": "bpp")",
                            R"("solver": "admm")",
                            {"/settings/solver: must be pgs, bpp, xpbd or newton, not \"admm\""}},
                    BadFile{"CountZero",
                            R"("n": 16)",
                            R"("n": 0)",
                            {"/settings/n: must be a whole number from 1 to 10000, not 0"}},
                    BadFile{"CountFraction",
                            R"("n": 16)",
                            R"("n": 2.5)",
                            {"/settings/n: must be a whole number from 1 to 10000, not 2.5"}},
                    BadFile{"CountAsText",
                            R"("n": 16)",
                            R"("n": "16")",
                            {"/settings/n: must be a whole number from 1 to 10000, not \"16\""}},
                    BadFile{"FlagAsNumber",
                            R"("probe": true)",
                            R"("probe": 1)",
                            {"/settings/probe: must be true or false, not 1"}},
                    BadFile{"HoldZero",
                            R"("n": 16)",
                            R"("hold": 0)",
                            {"/settings/hold: must be a whole number from 1 to 10000, not 0"}},
                    BadFile{"MemoryOne",
                            R"("n": 16)",
                            R"("memory": 1)",
                            {"/settings/memory: must be at least 0 and below 1, not 1"}},
                    BadFile{"AlphaMOne",
                            R"("n": 16)",
                            R"("alpha_m": 1)",
                            {"/settings/alpha_m: must be above 0 and below 1, not 1"}},
                    BadFile{"TauTooLong",
                            R"("n": 16)",
                            R"("tau": 20)",
                            {"/settings/tau: must be from 1e-6 to 10 (s), not 20"}},
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
                {"/joints/1/b: must be a different body from a"}},
        BadFile{
            "JointFromStaticBody",
            R"("a": "ball")",
            R"("a": "floor")",
            {"/joints/1/a: must be a moving body, not a static one; b may be static or \"world\""}},
        BadFile{
            "JointFromWorld",
            R"("a": "ball")",
            R"("a": "world")",
            {"/joints/1/a: must be a moving body, not \"world\"; b may be static or \"world\""}},
        BadFile{"AnchorsApart",
                "\"anchor_b\": [0.5, 0, 0]",
                "\"anchor_b\": [0.5, 0, 0.25]",
                {"/joints/1: the anchors start 0.25 apart, which is more than 0.1 (m)"}},
        BadFile{"AxesApart",
                R"("axis_b": [0, 0, 1])",
                R"("axis_b": [0, 1, 0])",
                {"/joints/0: the axes start at an angle with sine 1, which is more than 0.1"}},
        BadFile{"AxesOpposite",
                R"("axis_b": [0, 0, 1])",
                R"("axis_b": [0, 0, -1])",
                {"/joints/0: the axes start in opposite directions"}},
        BadFile{
            "RedundantRows",
            R"("b": "arm", "anchor_a": [-0.5, 0, 0],
     "anchor_b": [0.5, 0, 0], "compliance": 1e-8)",
            R"("b": "arm", "anchor_a": [-0.5, 0, 0], "anchor_b": [0.5, 0, 0]},
    {"name": "twin", "type": "ball", "a": "arm", "b": "ball", "anchor_a": [0.5, 0, 0.1],
     "anchor_b": [-0.5, 0, 0.1])",
            {"/joints/2/compliance: 0 here and in \"socket\" between the same bodies: \"socket\" "
             "and \"twin\" are redundant, so one of them must be above 0 (m/N)"}},
        BadFile{"StiffContact",
                R"("compliance": 1e-9)",
                R"("compliance": 0)",
                {"/contact/compliance: must be above 0 (m/N), not 0: a box that lies on its face "
                 "has redundant contacts"}},
        BadFile{"StiffFriction",
                R"("compliance": 1e-9)",
                R"("friction_compliance": 0)",
                {"/contact/friction_compliance: must be above 0 (m/N), not 0: a box that lies on "
                 "its face has redundant contacts"}},
        BadFile{"JointsNotListed",
                R"("gravity", "joints")",
                R"("gravity")",
                {"/effects: \"joints\" is missing, but /joints has 2"}},
        BadFile{"GravityNotListed",
                R"("gravity", "joints")",
                R"("joints")",
                {"/effects: \"gravity\" is missing, but /gravity is given"}},
        BadFile{"FrictionNotListed",
                R"(, "friction"])",
                "]",
                {"/effects: \"friction\" is missing, but /bodies/1/friction is 0.5"}},
        BadFile{"RestitutionTooLarge",
                R"("friction": 0.5)",
                R"("friction": 0.5, "restitution": 1.5)",
                {"/bodies/1/restitution: must be at most 1, not 1.5"}},
        BadFile{"RestitutionNotListed",
                R"("friction": 0.5)",
                R"("friction": 0.5, "restitution": 0.5)",
                {"/effects: \"restitution\" is missing, but /bodies/1/restitution is 0.5"}},
        BadFile{"ColorOfNoKind",
                R"("friction": 0.5)",
                R"("friction": 0.5, "color": "#12345g")",
                {"/bodies/1/color: must be a colour like \"#ff8800\", not \"#12345g\""}},
        BadFile{"ContactNotListed",
                R"("contact", "friction"])",
                R"("friction"])",
                {"/effects: \"contact\" is missing, but /contact is given",
                 "/effects: \"contact\" is missing, but \"friction\" needs it"}},
        BadFile{"OtherVersion",
                R"("version": 1)",
                R"("version": 3)",
                {"/version: must be a whole number from 1 to 2, not 3"}},
        BadFile{"OtherFormat",
                R"("substep-scene")",
                R"("gltf")",
                {"/format: must be \"substep-scene\", not \"gltf\""}}),
    kind_of);

/// The valid scene with a limit, a motor or a drive of its hinge.
List problems_with(const std::string& part, const std::string& effects) {
  const std::string axis = R"("axis_b": [0, 0, 1])";
  return problems_of(with(axis, axis + ", " + part, with(R"("friction"])", effects)));
}

TEST(SceneProblems, OfLimitsAndMotors) {
  const std::string across = R"("across_a": [1, 0, 0], "across_b": [1, 0, 0]})";
  const std::string listed = R"("friction", "limits", "motors"])";
  const auto limit = [&](const std::string& numbers) {
    return problems_with(R"("limit": {)" + numbers + ", " + across, listed);
  };
  EXPECT_EQ(limit(R"("lower": -1, "upper": 1)"), List{});
  EXPECT_EQ(limit(R"("lower": 1, "upper": 1)"),
            List{"/joints/0/limit: upper must be above lower, 1, not 1"});
  EXPECT_EQ(limit(R"("lower": -4, "upper": 4)"),
            List{"/joints/0/limit: upper and lower must be less than a full turn apart, not 8 "
                 "(rad)"});
  EXPECT_EQ(limit(R"("lower": -1, "upper": 7)"),
            List{"/joints/0/limit/upper: must be at most 6.3 (rad), not 7"});
  EXPECT_EQ(limit(R"("lower": 1, "upper": 2)"),
            List{"/joints/0/limit: the angle starts at 0 (rad), outside 1 to 2"});
  EXPECT_EQ(
      limit(R"("lower": -1, "upper": 1, "high": 2)"),
      List{"/joints/0/limit/high: unknown key (known here: lower, upper, restitution, across_a "
           "or across_b)"});
  EXPECT_EQ(limit(R"("lower": -1, "upper": 1, "restitution": 0.5)"),
            List{"/effects: \"restitution\" is missing, but a limit has a restitution above 0"});
  EXPECT_EQ(problems_with(R"("limit": {"lower": -1, "upper": 1})", listed),
            (List{"/joints/0/limit/across_a: missing", "/joints/0/limit/across_b: missing"}));
  EXPECT_EQ(problems_with(R"("limit": {"upper": 1, "across_a": [0, 0.6, 0.8], )"
                          R"("across_b": [1, 0, 0]})",
                          listed),
            List{"/joints/0/limit: across_a must be perpendicular to the axis: the cosine of their "
                 "angle is 0.8, which is more than 1e-6"});
  EXPECT_EQ(problems_with(R"("limit": 3)", listed),
            List{"/joints/0/limit: must be an object, not 3"});
  EXPECT_EQ(problems_with(R"("motor": {"velocity": 1, "torque": 0, "force": 3})", listed),
            (List{"/joints/0/motor/torque: must be above 0 (N m), not 0",
                  "/joints/0/motor/force: unknown key (known here: velocity or torque)"}));
  EXPECT_EQ(problems_with(R"("motor": {"torque": 1})", R"("friction"])"),
            List{"/effects: \"motors\" is missing, but /joints/0/motor is given"});
  EXPECT_EQ(problems_with(R"("limit": {"upper": 1, )" + across, R"("friction"])"),
            List{"/effects: \"limits\" is missing, but /joints/0/limit is given"});
}

TEST(SceneProblems, OfSprings) {
  const std::string across = R"("across_a": [1, 0, 0], "across_b": [1, 0, 0]})";
  const auto spring = [&](const std::string& numbers, const std::string& effects) {
    return problems_with(R"("spring": {)" + numbers + ", " + across, effects);
  };
  const std::string listed = R"("friction", "springs"])";
  EXPECT_EQ(spring(R"("rest": 20, "stiffness": 1e5)", listed), List{});
  EXPECT_EQ(spring(R"("damping": 2)", listed), List{});
  EXPECT_EQ(spring(R"("rest": 1)", listed),
            List{"/joints/0/spring: stiffness or damping must be above 0"});
  EXPECT_EQ(spring(R"("stiffness": -1)", listed),
            List{"/joints/0/spring/stiffness: must be at least 0 (N m/rad), not -1"});
  EXPECT_EQ(spring(R"("damping": 2)", R"("friction"])"),
            List{"/effects: \"springs\" is missing, but /joints/0/spring is given"});
}

TEST(SceneProblems, OfRopesWithoutTheirEffect) {
  SceneBuilder builder("rope");
  const int ball = builder.add_body(Sphere{0.1}, 1.0, {0.5, 0.0, 0.0});
  builder.add_rope(ball, kWorld, {0.5, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1.0);
  Scene scene = *builder.build();
  scene.effects.limits = false;
  EXPECT_EQ(problems_of(write_scene(scene)),
            List{"/effects: \"limits\" is missing, but /joints/0 is a rope"});
}

TEST(SceneProblems, OfDrives) {
  const std::string across = R"("across_a": [1, 0, 0], "across_b": [1, 0, 0]})";
  const std::string listed = R"("friction", "drives"])";
  const auto drive = [&](const std::string& numbers) {
    return problems_with(R"("drive": {)" + numbers + ", " + across, listed);
  };
  EXPECT_EQ(drive(R"("target": 20, "velocity": 1, "stiffness": 1e5, "torque": 3)"), List{});
  EXPECT_EQ(drive(R"("damping": 2)"), List{});
  EXPECT_EQ(drive(R"("target": 1)"), List{"/joints/0/drive: stiffness or damping must be above 0"});
  EXPECT_EQ(drive(R"("stiffness": -1, "damping": 1e22, "torque": 0)"),
            (List{"/joints/0/drive/stiffness: must be at least 0 (N m/rad), not -1",
                  "/joints/0/drive/damping: must be at most 1e21 (N m s/rad), not 1e22",
                  "/joints/0/drive/torque: must be above 0 (N m), not 0"}));
  EXPECT_EQ(drive(R"("stiffness": 1, "target": 2e6)"),
            List{"/joints/0/drive/target: must be at most 1e6 (rad), not 2e6"});
  EXPECT_EQ(drive(R"("stiffness": 1, "force": 2)"),
            List{"/joints/0/drive/force: unknown key (known here: target, velocity, stiffness, "
                 "damping, torque, across_a or across_b)"});
  EXPECT_EQ(problems_with(R"("drive": {"stiffness": 1})", listed),
            (List{"/joints/0/drive/across_a: missing", "/joints/0/drive/across_b: missing"}));
  EXPECT_EQ(problems_with(R"("drive": {"stiffness": 1, "across_a": [1, 0, 0], )"
                          R"("across_b": [0, 0.6, 0.8]})",
                          listed),
            List{"/joints/0/drive: across_b must be perpendicular to the axis: the cosine of their "
                 "angle is 0.8, which is more than 1e-6"});
  EXPECT_EQ(problems_with(R"("drive": {"stiffness": 1, )" + across, R"("friction"])"),
            List{"/effects: \"drives\" is missing, but /joints/0/drive is given"});
}

TEST(SceneProblems, OfJointFriction) {
  const std::string listed = R"("friction", "joint_friction"])";
  EXPECT_EQ(problems_with(R"("friction": 0.5)", listed), List{});
  EXPECT_EQ(problems_with(R"("friction": 0)", listed),
            List{"/joints/0/friction: must be above 0 (N m), not 0"});
  EXPECT_EQ(problems_with(R"("friction": 1)", R"("friction"])"),
            List{"/effects: \"joint_friction\" is missing, but /joints/0/friction is given"});
}

TEST(SceneProblems, OfArmatures) {
  const std::string listed = R"("friction", "armature"])";
  EXPECT_EQ(problems_with(R"("armature": 0.01)", listed), List{});
  EXPECT_EQ(problems_with(R"("armature": 0)", listed),
            List{"/joints/0/armature: must be at least 1e-60 (kg m^2), not 0"});
  EXPECT_EQ(problems_with(R"("armature": 1)", R"("friction"])"),
            List{"/effects: \"armature\" is missing, but /joints/0/armature is given"});
}

}  // namespace
}  // namespace substep
