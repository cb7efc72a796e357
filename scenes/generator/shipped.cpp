#include <utility>

#include "scenes/generator/recommended.hpp"
#include "scenes/generator/scenes.hpp"
#include "scenes/generator/verdicts.hpp"

namespace substep::scenes {

std::vector<Scene> shipped() {
  std::vector<Scene> all{swinging_box(),
                         bridge(),
                         heavy_stack(),
                         heavy_stack_tall(),
                         heavy_stack_stress(),
                         heavy_stack_stress_tall(),
                         swinging_box_authors(),
                         bridge_authors(),
                         heavy_stack_authors(),
                         pendulum(),
                         spinning_top(),
                         spherical_pendulum(),
                         heavy_top(),
                         whirling_chain(),
                         crank_rocker(),
                         thrown_rope(),
                         sliding_box(),
                         free_fall(),
                         bouncing_balls(),
                         newtons_cradle(),
                         wrecking_ball(),
                         convoy(),
                         card_house(),
                         ragdoll_drop(),
                         wall()};
  Problems problems;  // none: checked by a test
  const auto recommended = recommendations(problems);
  for (Scene& scene : all) {
    scene.verdicts = verdicts_of(scene.name);
    const auto found = recommended.find(scene.name);
    if (found != recommended.end()) scene = recommending(std::move(scene), found->second);
  }
  return all;
}

}  // namespace substep::scenes
