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
                         sliding_box(),
                         free_fall(),
                         bouncing_balls(),
                         newtons_cradle(),
                         wrecking_ball(),
                         card_house(),
                         ragdoll_drop(),
                         wall()};
  for (Scene& scene : all) scene.verdicts = verdicts_of(scene.name);
  return all;
}

}  // namespace substep::scenes
