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
  std::vector<Vec3> v;        // [m/s]
  std::vector<Vec3> w;        // angular velocities, world axes [rad/s]
};

/// A line per frame: milliseconds, then x y z, w x y z of every body, then the two velocities of
/// every body.
void print(const std::vector<PeerFrame>& frames);

/// Replaces velocities that are older than the poses by those at the time of the poses.
/// @param lag their age, as a share of a step [-]  @param next the velocities a step later
void synchronise(PeerFrame& frame, const PeerFrame& next, double lag);

/// @param world has steps(), the number of steps in a frame; step(), one of them; lag(), the age of
/// its velocities when it has stepped, as a share of a step; poses(PeerFrame&) and
/// velocities(PeerFrame&)
template <class World>
std::vector<PeerFrame> simulate(World& world, int count) {
  std::vector<PeerFrame> frames(static_cast<std::size_t>(count));
  const auto timed = [&world](int steps) {
    const double start = now_ms();
    for (int i = 0; i < steps; ++i) world.step();
    return now_ms() - start;
  };
  const auto finish = [&world](PeerFrame& frame) {
    PeerFrame next;
    world.velocities(next);
    synchronise(frame, next, world.lag());
  };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].milliseconds = timed(1);
    if (i > 0) finish(frames[i - 1]);
    frames[i].milliseconds += timed(world.steps() - 1);
    world.poses(frames[i]);
    world.velocities(frames[i]);
  }
  if (frames.empty()) return frames;
  world.step();
  finish(frames.back());
  return frames;
}

}  // namespace substep::bench
