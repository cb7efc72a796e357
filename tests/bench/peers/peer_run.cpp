#include "tests/bench/peers/peer_run.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/io/scene_reader.hpp"

namespace substep::bench {

std::shared_ptr<const Scene> load(const char* path) {
  SceneResult read = read_scene_file(path);
  for (const Problem& problem : read.problems) {
    std::fprintf(stderr, "%s: %s\n", path, to_string(problem).c_str());
  }
  if (!read.scene) std::exit(2);
  return read.scene;
}

void refuse(const std::string& why) {
  std::fprintf(stderr, "error: %s\n", why.c_str());
  std::exit(2);
}

PeerArguments read_peer_arguments(int argc, char** argv) {
  if (argc < 4) refuse("usage: PROGRAM SCENE.json FRAMES WARM_UP [SETTING=VALUE...]");
  PeerArguments arguments{load(argv[1]), std::atoi(argv[2]), std::atoi(argv[3]), {}};
  for (int i = 4; i < argc; ++i) {
    const std::string text = argv[i];
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) refuse("must be SETTING=VALUE, not '" + text + "'");
    arguments.settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return arguments;
}

double now_ms() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(time).count();
}

void synchronise(PeerFrame& frame, const PeerFrame& next, double lag) {
  for (std::size_t i = 0; i < frame.v.size(); ++i) {
    frame.v[i] += lag * (next.v[i] - frame.v[i]);
    frame.w[i] += lag * (next.w[i] - frame.w[i]);
  }
}

void print(const std::vector<PeerFrame>& frames) {
  for (const PeerFrame& frame : frames) {
    std::printf("%.6g", frame.milliseconds);
    for (std::size_t i = 0; i < frame.x.size(); ++i) {
      const Vec3& x = frame.x[i];
      const Quat& q = frame.q[i];
      std::printf(" %.12g %.12g %.12g %.12g %.12g %.12g %.12g", x.x(), x.y(), x.z(), q.w(), q.x(),
                  q.y(), q.z());
    }
    for (std::size_t i = 0; i < frame.x.size(); ++i) {
      for (const Vec3& rate : {frame.v[i], frame.w[i]}) {
        std::printf(" %.12g %.12g %.12g", rate.x(), rate.y(), rate.z());
      }
    }
    std::printf("\n");
  }
}

}  // namespace substep::bench
