#include <gtest/gtest.h>

#include <string>

#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(SceneMenu, VariantsAreThoseWhoseNamesBeginWithTheirScenes) {
  const Library library = shipped();
  for (const auto& [name, base] : {std::pair{"heavy_stack_tall", "heavy_stack"},
                                   {"heavy_stack_stress_tall", "heavy_stack"},
                                   {"bridge_authors", "bridge"},
                                   {"swinging_box_authors", "swinging_box"}}) {
    const Scene* found = library.base_of(*library.find(name));
    ASSERT_NE(found, nullptr) << name;
    EXPECT_EQ(found->name, base);
  }
  EXPECT_EQ(library.base_of(*library.find("heavy_stack")), nullptr);
  EXPECT_EQ(library.base_of(*library.find("heavy_top")), nullptr);
  EXPECT_EQ(library.variants_of(*library.find("heavy_stack")).size(), 4U);
}

TEST(SceneMenu, EverySceneIsInItOnce) {
  const Library library = shipped();
  std::size_t count = 0;
  for (const auto& scene : library.scenes()) {
    if (library.base_of(*scene) == nullptr) count += 1 + library.variants_of(*scene).size();
  }
  EXPECT_EQ(count, library.scenes().size());
}

TEST(SceneMenu, AVariantIsUnfoldedAndChosen) {
  Headless h(1280.0F, 1200.0F);
  h.press("scene");
  h.frames(4);
  ASSERT_NE(find_handle("Heavy stack"), nullptr);
  EXPECT_EQ(find_handle("tall"), nullptr);
  h.press("Variants of Heavy stack");
  h.frames(2);
  h.press("tall");
  EXPECT_EQ(h.app->session.scene().name, "heavy_stack_tall");
  h.frames(4);
  h.press("scene");
  h.frames(4);
  EXPECT_NE(find_handle("stress"), nullptr) << "unfolded where one of them runs";
}

TEST(SceneMenu, AUsersSceneIsNoVariant) {
  Headless h;
  Scene own = *h.app->library.find("bridge");
  own.name = "bridge_mine";
  const auto added = h.app->add_own(own);
  EXPECT_EQ(h.app->library.base_of(*added), nullptr);
}

}  // namespace
}  // namespace substep
