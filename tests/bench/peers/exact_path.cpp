// The exact position of the tracked body of a scene after every frame: exact_path SCENE.json prints
// x y z [m], a line per frame. A scene whose motion is not known well enough is rejected.

#include <cstdio>

#include "core/lab/reference.hpp"
#include "tests/bench/peers/peer_run.hpp"

int main(int argc, char** argv) {
  using namespace substep;
  if (argc != 2) bench::refuse("usage: exact_path SCENE.json");
  const std::shared_ptr<const Scene> scene = bench::load(argv[1]);
  const Reference reference = find_reference(scene, scene->criteria.duration);
  constexpr double kEnough = 1e-6;  // uncertainty of a reference that is not exact [m]
  std::fprintf(stderr, "%s, within %.1e m\n", reference.source.c_str(), reference.uncertainty);
  if (!reference.source.starts_with("exact") && !(reference.uncertainty <= kEnough)) {
    bench::refuse("that is not well enough");
  }
  for (std::size_t i = 1; i < reference.track.size(); ++i) {
    const Vec3& x = reference.track[i];
    std::printf("%.15g %.15g %.15g\n", x.x(), x.y(), x.z());
  }
  return 0;
}
