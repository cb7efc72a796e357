#pragma once
// Shared by the programs of the peer bench: their command line and the output format of a run.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/model/scene.hpp"

namespace substep::bench {

/// PROGRAM SCENE.json FRAMES WARM_UP [SETTING=VALUE...]
struct PeerArguments {
  std::shared_ptr<const Scene> scene;
  int frames = 0;
  int warm_up = 0;  // warm-up frames of a separate run that is discarded
  std::vector<std::pair<std::string, std::string>> settings;
};

/// On an error the program ends, with the reason on stderr.
std::shared_ptr<const Scene> load(const char* path);
PeerArguments read_peer_arguments(int argc, char** argv);
[[noreturn]] void refuse(const std::string& why);

/// [ms], from an arbitrary fixed moment
double now_ms();

/// A frame of a run.
struct PeerFrame {
  double milliseconds = 0.0;  // of physics
  std::vector<Vec3> x;        // centres of mass, in the order of the scene file [m]
  std::vector<Quat> q;        // q_WB
};

/// A line per frame: milliseconds, then x y z, w x y z of every body.
void print(const std::vector<PeerFrame>& frames);

/// @param world has step(), one frame of physics, and poses(PeerFrame&)
template <class World>
std::vector<PeerFrame> simulate(World& world, int count) {
  std::vector<PeerFrame> frames(static_cast<std::size_t>(count));
  for (PeerFrame& frame : frames) {
    const double start = now_ms();
    world.step();
    frame.milliseconds = now_ms() - start;
    world.poses(frame);
  }
  return frames;
}

}  // namespace substep::bench
