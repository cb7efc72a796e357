#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/output.hpp"
#include "app/cli/within.hpp"
#include "core/io/scene_writer.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

/// Exact for the angles that the scenes use; others use the platform's sine.
scenes::Angle angle_of_degrees(double degrees) {
  if (degrees == 60.0) return scenes::kSixtyDegrees;
  constexpr double kDegree = 0.017453292519943295;
  return {std::sin(degrees * kDegree), std::cos(degrees * kDegree)};
}

struct GenerateOptions {
  std::string out = "-";
  double angle_deg = 60.0;
  std::array<double, 3> anchor{0.0, 0.0, 0.0};  // of the rope [m]
  scenes::RopeOptions rope;
  scenes::SwingingBoxOptions swinging_box;
  scenes::BridgeOptions bridge;
  scenes::HeavyStackOptions stack;
  scenes::SlopeOptions slope;
};

int write(const Scene& scene, const std::string& out) {
  return write_file(out, write_scene(scene)) ? kOk : kBadInput;
}

}  // namespace

void add_generate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<GenerateOptions>();
  GenerateOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("generate", "Write a variant of a shipped scene as a scene file");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  substep generate rope --links 100 | substep run -\n"
      "  substep generate rope --links 5 --link-mass 0.2 --box-size 0.5 --anchor 0 8 0\n"
      "  substep generate bridge --ball-x -4 --ball-speed 4 --out fast.json");

  const auto add = [&](const char* name, const char* help, Scene (*make)(const GenerateOptions&)) {
    CLI::App* kind = command->add_subcommand(name, help);
    kind->option_defaults()->always_capture_default();
    kind->add_option("--out", o.out, "file to write, - for standard output")->check(named());
    kind->callback(
        [options, make, &exit_code] { exit_code = write(make(*options), options->out); });
    return kind;
  };
  const CLI::Validator angle = within(-89.0, 89.0);
  const CLI::Validator compliance = within(0.0, 1e3);

  CLI::App* rope =
      add("rope", "hinged links with a heavy box at the end", [](const GenerateOptions& from) {
        scenes::RopeOptions rope_options = from.rope;
        rope_options.angle = angle_of_degrees(from.angle_deg);
        rope_options.anchor = Vec3(from.anchor.data());
        return scenes::rope_of_n(rope_options);
      });
  rope->add_option("-n,--links", o.rope.n, "links")->check(whole(1, 19999));
  rope->add_option("--angle", o.angle_deg, "initial angle from the vertical [deg]")->check(angle);
  rope->add_option("--anchor", o.anchor, "suspension point: x y z [m]")->check(within(-1e5, 1e5));
  rope->add_option("--link-length", o.rope.link_length, "[m]")->check(within(1e-3, 10.0));
  rope->add_option("--link-width", o.rope.link_width, "of its square cross-section [m]")
      ->check(within(1e-3, 10.0));
  rope->add_option("--link-mass", o.rope.link_mass, "of one link [kg]")->check(within(1e-6, 1e9));
  rope->add_option("--box-size", o.rope.box_size, "edge of the box [m]")
      ->check(within(1e-3, 100.0));
  rope->add_option("--end-mass", o.rope.end_mass, "of the box [kg]")->check(within(1e-6, 1e9));
  rope->add_option("--compliance", o.rope.compliance, "of the joints [m/N]")->check(compliance);

  CLI::App* box = add("swinging_box", "a heavy box on a chain", [](const GenerateOptions& from) {
    scenes::SwingingBoxOptions box_options = from.swinging_box;
    box_options.angle = angle_of_degrees(from.angle_deg);
    return scenes::swinging_box(box_options);
  });
  box->add_option("--angle", o.angle_deg, "initial angle from the vertical [deg]")->check(angle);
  box->add_option("--compliance", o.swinging_box.compliance, "of the joints [m/N]")
      ->check(compliance);

  CLI::App* bridge = add("bridge", "a heavy ball on hanging planks",
                         [](const GenerateOptions& from) { return scenes::bridge(from.bridge); });
  bridge->add_option("--ball-x", o.bridge.ball_x, "initial position of the ball [m]")
      ->check(within(-4.6, 4.6));
  bridge->add_option("--ball-speed", o.bridge.ball_speed, "[m/s]")->check(within(-50.0, 50.0));
  bridge->add_option("--span", o.bridge.span, "span that the 10 m of planks bridge [m]")
      ->check(within(9.0, 9.94));

  CLI::App* stack =
      add("heavy_stack", "layers of balls and plates under a heavy box",
          [](const GenerateOptions& from) { return scenes::heavy_stack(from.stack); });
  stack->add_option("--layers", o.stack.layers, "layers")->check(whole(1, 1000));
  stack->add_option("--top-mass", o.stack.top_mass, "of the box [kg]")->check(within(1e-3, 1e9));
  stack->add_option("--alpha", o.stack.alpha, "of the settings")->check(within(1e-6, 1.0));
  stack->add_option("--compliance", o.stack.compliance, "of the contacts [m/N]")
      ->check(within(1e-300, 1e3));
  stack->add_flag("--stress", o.stack.stress, "with regularisation and displaced balls");

  CLI::App* slope =
      add("sliding_box", "a box on a slope of 5 in 12",
          [](const GenerateOptions& from) { return scenes::sliding_box(from.slope); });
  slope->add_option("--friction", o.slope.friction, "Coulomb coefficient")
      ->check(within(0.0, 100.0));
}

}  // namespace substep::cli
