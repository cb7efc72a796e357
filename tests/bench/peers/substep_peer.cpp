// One run of a scene, told the way every engine of the peer bench tells it: natively and, compiled
// to WebAssembly, under Node.js.
//
// Prints a line a frame: the milliseconds of physics it took, then position and orientation
// (x y z, w x y z) of every body in the order of the scene file. What is off or open is measured
// from these poses by the same code for all engines.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/io/scene_reader.hpp"
#include "core/io/setting_fields.hpp"
#include "core/sim/simulator.hpp"

namespace {

using namespace substep;

struct Frame {
  double milliseconds = 0.0;
  std::vector<Vec3> x;  // [m]
  std::vector<Quat> q;  // q_WB
};

double now_ms() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(time).count();
}

[[noreturn]] void refuse(const std::string& why) {
  std::fprintf(stderr, "substep_peer: %s\n", why.c_str());
  std::exit(2);
}

std::shared_ptr<const Scene> load(const char* path) {
  SceneResult read = read_scene_file(path);
  for (const Problem& problem : read.problems) {
    std::fprintf(stderr, "%s: %s\n", path, to_string(problem).c_str());
  }
  if (!read.scene) std::exit(2);
  return read.scene;
}

void apply(const std::string& assignment, Settings& settings) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) refuse("'" + assignment + "' is not SETTING=VALUE");
  const std::string name = assignment.substr(0, equals);
  const SettingField* field = find_setting(name);
  if (!field) refuse("there is no setting '" + name + "'");
  if (const auto problem = set_setting(*field, assignment.substr(equals + 1), settings)) {
    refuse(name + ": " + *problem);
  }
}

std::vector<Frame> simulate(Simulator& simulator, int count) {
  std::vector<Frame> frames(static_cast<std::size_t>(count));
  for (Frame& frame : frames) {
    const double start = now_ms();
    simulator.step();
    frame.milliseconds = now_ms() - start;
    frame.x = simulator.state().x;
    frame.q = simulator.state().q;
  }
  return frames;
}

void print(const Frame& frame) {
  std::printf("%.6g", frame.milliseconds);
  for (std::size_t i = 0; i < frame.x.size(); ++i) {
    const Vec3& x = frame.x[i];
    const Quat& q = frame.q[i];
    std::printf(" %.12g %.12g %.12g %.12g %.12g %.12g %.12g", x.x(), x.y(), x.z(), q.w(), q.x(),
                q.y(), q.z());
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: substep_peer SCENE.json FRAMES WARM_UP [SETTING=VALUE...]\n");
    return 2;
  }
  const auto scene = load(argv[1]);
  Settings settings = scene->settings;
  for (int i = 4; i < argc; ++i) apply(argv[i], settings);
  Simulator simulator(scene);
  simulator.set_settings(settings);
  // Under Node.js the code is compiled once it has run for a while; scratch gets its size.
  simulate(simulator, std::atoi(argv[3]));
  simulator.reset();
  for (const Frame& frame : simulate(simulator, std::atoi(argv[2]))) print(frame);
  return 0;
}
