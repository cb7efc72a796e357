// One run of a scene by this project, natively or, compiled to WebAssembly, under Node.js.
//
// Settings: those of the library, on top of the scene's own or of those of a preset named before
// them (preset=paper).

#include "core/lab/presets.hpp"
#include "core/model/setting_fields.hpp"
#include "core/sim/simulator.hpp"
#include "tests/bench/peers/peer_run.hpp"

namespace {

using namespace substep;

class World {
 public:
  explicit World(const bench::PeerArguments& arguments) : simulator_(arguments.scene) {
    Settings settings = arguments.scene->settings;
    for (const auto& [name, value] : arguments.settings) {
      if (name == "preset") {
        const Preset* preset = find_preset(value);
        if (!preset) bench::refuse("no preset is called '" + value + "'");
        settings = preset->settings;
        continue;
      }
      const SettingField* field = find_setting(name);
      if (!field) bench::refuse("no setting is called '" + name + "'");
      const auto problem = set_setting(*field, value, settings);
      if (problem) bench::refuse(name + ": " + *problem);
    }
    simulator_.set_settings(settings);
    simulator_.set_measures({.energies = false, .errors = false, .stages = false});
  }

  [[nodiscard]] static int steps() { return 1; }
  void step() { simulator_.step(); }

  void poses(bench::PeerFrame& frame) const {
    frame.x = simulator_.state().x;
    frame.q = simulator_.state().q;
  }

  /// Those at the time of the poses, which State holds beside those of the integrator.
  [[nodiscard]] static double lag() { return 0.0; }
  void velocities(bench::PeerFrame& frame) const {
    for (const Vec6& u : simulator_.state().u_synchronised) {
      frame.v.emplace_back(u.head<3>());
      frame.w.emplace_back(u.tail<3>());
    }
  }

  void reset() { simulator_.reset(); }

 private:
  Simulator simulator_;
};

}  // namespace

int main(int argc, char** argv) {
  const bench::PeerArguments arguments = bench::read_peer_arguments(argc, argv);
  World world(arguments);
  // Warm-up: Node.js optimises the code, and scratch memory is sized.
  bench::simulate(world, arguments.warm_up);
  world.reset();
  bench::print(bench::simulate(world, arguments.frames));
  return 0;
}
