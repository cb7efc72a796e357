// Choosing a scene file in the window.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "app/shell/file_browser.hpp"
#include "core/io/scene_writer.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

namespace fs = std::filesystem;

// A folder with valid and invalid scenes for the running test, removed afterwards.
class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() / "substep_files_test" /
              testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(path_);
    fs::create_directories(path_ / "inner");
    Scene scene = *shipped("pendulum");
    scene.name = "mine";
    scene.title = "Mine";
    write("good.json", write_scene(scene));
    write("bad.json", "{\"bodies\": 3}");
    write("notes.txt", "no scene");
    write(".hidden.json", "{}");
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  void write(const char* name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  fs::path path_;
};

TEST(FileBrowser, ListsFoldersAndSceneFilesAndNothingElse) {
  const Folder folder;
  FileBrowser browser;
  EXPECT_FALSE(browser.open());
  browser.show(folder.path());
  EXPECT_TRUE(browser.open());
  ASSERT_EQ(browser.entries().size(), 3U);
  EXPECT_EQ(browser.entries()[0].name, "inner");
  EXPECT_TRUE(browser.entries()[0].folder);
  EXPECT_EQ(browser.entries()[1].name, "bad.json");
  EXPECT_EQ(browser.entries()[2].name, "good.json");
}

TEST(FileBrowser, FollowsTheTypedPath) {
  const Folder folder;
  FileBrowser browser;
  browser.show(folder.path());
  EXPECT_TRUE(browser.follow("inner").empty());
  EXPECT_EQ(browser.folder().filename(), "inner");
  EXPECT_EQ(browser.follow("../good.json").filename(), "good.json");
  EXPECT_TRUE(browser.follow("../nowhere").empty());
  EXPECT_NE(browser.problem(), "");
  EXPECT_EQ(browser.folder().filename(), "inner") << "it stays where it was";
  EXPECT_TRUE(browser.follow((folder.path() / "inner" / "..").string()).empty());
  EXPECT_EQ(browser.folder(), fs::canonical(folder.path()));
  EXPECT_EQ(browser.problem(), "");
}

// The position of the entry: rows of a menu below the path field.
void click_entry(Headless& h, const char* name) {
  for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
    if (!w->WasActive || std::string(w->Name).find("##open_file/entries") == std::string::npos) {
      continue;
    }
    const float row = h.app->look.m.row + 2.0F + h.app->look.m.gap;
    const auto& entries = h.app->browser.entries();
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].name != name) continue;
      // The first line is the folder above.
      h.click(w->Pos.x + 60.0F, w->Pos.y + row * (static_cast<float>(i) + 1.5F));
      return;
    }
  }
  FAIL() << name << " is not listed";
}

TEST(FileBrowser, AFileIsOpenedByAClickAndABadOneIsReported) {
  const Folder folder;
  for (const float width : {1280.0F, 390.0F}) {
    Headless h(width, width > 900.0F ? 720.0F : 844.0F);
    h.app->browser.show(folder.path());
    h.frames(4);
    click_entry(h, "inner");
    EXPECT_EQ(h.app->browser.folder().filename(), "inner");
    h.app->browser.show(folder.path());
    h.frames(2);
    click_entry(h, "bad.json");
    EXPECT_EQ(h.app->trouble.title, "bad.json was not loaded");
    EXPECT_TRUE(h.app->browser.open()) << "to choose another one";
    EXPECT_EQ(h.app->session.scene().name, "swinging_box");
    h.frames(2);
    ImGui::GetIO().AddKeyEvent(ImGuiKey_Escape, true);
    h.frames(2);
    ImGui::GetIO().AddKeyEvent(ImGuiKey_Escape, false);
    h.frames(2);
    EXPECT_TRUE(h.app->trouble.title.empty());
    ASSERT_TRUE(h.app->browser.open()) << "the first Esc is the message's";
    click_entry(h, "good.json");
    EXPECT_EQ(h.app->session.scene().name, "mine");
    EXPECT_FALSE(h.app->browser.open());
  }
}

}  // namespace
}  // namespace substep
