// Figures as SVG: texts, shapes, and the experiment inside.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <string>

#include "app/ui/panels.hpp"
#include "core/io/experiment.hpp"
#include "tests/app/ui/ui_sweep.hpp"

namespace substep {
namespace {

struct SavedFigure {
  std::string name;
  std::string text;
};

SavedFigure save_figure(Headless& h, const Figure& figure) {
  SavedFigure saved;
  h.app->host.save_file = [&](const std::string& name, const std::string& text) {
    saved = {name, text};
  };
  h.app->desk.figure = figure;
  h.frames(1);
  return saved;
}

std::string text_between(const std::string& text, const std::string& open,
                         const std::string& close) {
  const std::size_t from = text.find(open);
  if (from == std::string::npos) return "";
  const std::size_t at = from + open.size();
  return text.substr(at, text.find(close, at) - at);
}

std::string unescaped_text(std::string text) {
  for (const auto& [name, c] :
       {std::pair{"&quot;", '"'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}}) {
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; ++at) {
      text.replace(at, std::string(name).size(), 1, c);
    }
  }
  return text;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
  return n;
}

TEST(Figure, PlotsHaveTheirTextsCurvesAndExperiment) {
  Headless h;
  ASSERT_EQ(h.app->set("alpha", "0.05"), "");
  h.app->session.play();
  h.frames(90);
  h.app->session.pause();
  h.frames(2);
  const SavedFigure figure = save_figure(h, {"plots.svg", h.app->desk.plots_area});
  EXPECT_EQ(figure.name, "plots.svg");
  EXPECT_TRUE(figure.text.starts_with("<svg "));
  EXPECT_TRUE(figure.text.ends_with("</svg>\n"));
  EXPECT_EQ(occurrences(figure.text, "<g "), occurrences(figure.text, "</g>"));
  EXPECT_NE(figure.text.find(">SUB-STEPS PER FRAME</text>"), std::string::npos)
      << figure.text.substr(0, 3000);
  EXPECT_NE(figure.text.find("total</text>"), std::string::npos);
  EXPECT_GT(occurrences(figure.text, "<path"), 20U);
  EXPECT_EQ(figure.text.find("nan"), std::string::npos);
  EXPECT_FALSE(h.app->desk.figure.has_value());

  // The experiment inside runs again.
  Problems problems;
  const Json about =
      Json::parse(unescaped_text(text_between(figure.text, "<metadata>", "</metadata>")));
  const auto find = [&](const std::string& name) { return h.app->library.find(name); };
  Json experiment = about;
  experiment.erase("link");
  experiment.erase("citation");
  const ExperimentInput read = read_experiment(experiment, find, problems);
  ASSERT_TRUE(problems.empty()) << problems.front().message;
  EXPECT_EQ(read.experiment->settings.alpha, 0.05);
  EXPECT_EQ(about["link"], h.app->link());
  EXPECT_NE(text_between(figure.text, "<desc>", "</desc>").find("run swinging_box --alpha 0.05"),
            std::string::npos);
}

TEST(Figure, CapturesTheChartAndDoesNotChangeTheWindow) {
  Headless h;
  h.app->session.pause();
  h.app->desk.tab = Tab::kAccuracy;
  h.app->host.save_file = [](const std::string&, const std::string&) {};
  h.frames(3);
  const bool lines = ImGui::GetStyle().AntiAliasedLines;
  const std::size_t handles = ui::handles().size();
  const SavedFigure figure = save_figure(h, {"chart.svg", h.app->desk.accuracy_area});
  EXPECT_NE(figure.text.find("operations"), std::string::npos);
  EXPECT_EQ(ImGui::GetStyle().AntiAliasedLines, lines);
  EXPECT_EQ(ui::handles().size(), handles);
  h.frames(2);
  EXPECT_EQ(ui::handles().size(), handles);
  const SavedFigure again = save_figure(h, {"chart.svg", h.app->desk.accuracy_area});
  EXPECT_EQ(again.text, figure.text);
}

TEST(Figure, IsCompleteWhereThePanelIsScrolled) {
  Headless h;
  h.app->host.save_file = [](const std::string&, const std::string&) {};
  h.app->session.pause();
  h.app->desk.tab = Tab::kAccuracy;
  ASSERT_EQ(h.app->set("accuracy", "trade"), "");
  h.frames(3);
  ImGuiWindow* panel = ImGui::FindWindowByID(h.app->desk.accuracy_area.window);
  ASSERT_NE(panel, nullptr);
  ASSERT_GT(panel->ScrollMax.y, 0.0F) << "all of it is visible";
  ImGui::SetScrollY(panel, panel->ScrollMax.y);
  h.frames(3);
  const SavedFigure figure = save_figure(h, {"trade.svg", h.app->desk.accuracy_area});
  for (const char* text :
       {"Adaptive sub-stepping takes", "0.01 × load", "10 × load", "found by trial"}) {
    EXPECT_NE(figure.text.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(figure.text.find("Run again"), std::string::npos) << "outside its area";
  EXPECT_EQ(figure.text.find("sub-steps</text>"), std::string::npos) << "of another window";
  const float height = h.app->desk.accuracy_area.height;
  EXPECT_GT(height, panel->Size.y - 100.0F);
}

TEST(Figure, EscapesTheTextsOfAScene) {
  Headless h;
  auto scene = std::make_shared<Scene>(*h.app->library.scenes().front());
  scene->title = "<script>alert(1)</script> & \"quoted\"";
  h.app->run(scene);
  h.app->session.pause();
  h.frames(2);
  const SavedFigure figure = save_figure(h, {"plots.svg", h.app->desk.plots_area});
  EXPECT_EQ(figure.text.find("<script"), std::string::npos);
  EXPECT_NE(figure.text.find("<title>&lt;script&gt;"), std::string::npos);
}

}  // namespace
}  // namespace substep
