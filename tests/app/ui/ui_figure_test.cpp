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

Figure plots_of_run(Headless& h) {
  return {"plots.svg", 84.0,
          [&](const ui::Look& look) { ui::plots_figure(look, *h.app, h.app->desk); }};
}

Figure accuracy_of_scene(Headless& h, const char* name) {
  return {name, 174.0, [&](const ui::Look& look) { ui::accuracy_figure(look, *h.app); }};
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
  const SavedFigure figure = save_figure(h, plots_of_run(h));
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
  const SavedFigure figure = save_figure(h, accuracy_of_scene(h, "chart.svg"));
  EXPECT_NE(figure.text.find("operations"), std::string::npos);
  EXPECT_EQ(ImGui::GetStyle().AntiAliasedLines, lines);
  EXPECT_EQ(ui::handles().size(), handles);
  h.frames(2);
  EXPECT_EQ(ui::handles().size(), handles);
  const SavedFigure again = save_figure(h, accuracy_of_scene(h, "chart.svg"));
  EXPECT_EQ(again.text, figure.text);
}

// Its height exceeds that of the display.
TEST(Figure, IsCompleteBeyondTheEdgeOfTheDisplay) {
  Headless h(844.0F, 390.0F);
  h.app->host.save_file = [](const std::string&, const std::string&) {};
  h.app->session.pause();
  h.app->desk.tab = Tab::kAccuracy;
  ASSERT_EQ(h.app->set("accuracy", "trade"), "");
  h.frames(3);
  const SavedFigure figure = save_figure(h, accuracy_of_scene(h, "trade.svg"));
  for (const char* text : {"0.01 × load", "10 × load", "found by trial"}) {
    EXPECT_NE(figure.text.find(text), std::string::npos) << text;
  }
  const SavedFigure plots = save_figure(h, plots_of_run(h));
  EXPECT_NE(plots.text.find("0 s</text>"), std::string::npos) << "the time below the last plot";
  h.resize(1280.0F, 1600.0F, 1.0F);
  h.frames(3);
  EXPECT_EQ(occurrences(save_figure(h, plots_of_run(h)).text, "<text"),
            occurrences(plots.text, "<text"));
}

TEST(Figure, IsForPapersOnWhiteWithoutControlsAtTheChosenWidth) {
  for (const bool dark : {true, false}) {
    Headless h;
    h.app->desk.dark = dark;
    h.app->session.pause();
    h.app->desk.tab = Tab::kAccuracy;
    h.app->host.save_file = [](const std::string&, const std::string&) {};
    h.frames(3);
    const SavedFigure wide = save_figure(h, accuracy_of_scene(h, "chart.svg"));
    EXPECT_TRUE(wide.text.find("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"174mm\"") == 0)
        << wide.text.substr(0, 200);
    const SavedFigure plots = save_figure(h, plots_of_run(h));
    EXPECT_NE(plots.text.find("width=\"84mm\""), std::string::npos);
    for (const std::string& text : {wide.text, plots.text}) {
      EXPECT_NE(text.find("fill=\"#ffffff\"/>\n<"), std::string::npos) << "the ground";
      for (const char* control :
           {">Path<", ">Sub-steps</text>", ">Operations<", ">SVG<", ">Larger<", ">Run again<"}) {
        EXPECT_EQ(text.find(control), std::string::npos) << control;
      }
    }
  }
}

TEST(Figure, IsSavedFromTheMenusInTwoWidths) {
  Headless h;
  h.app->session.pause();
  h.app->desk.tab = Tab::kAccuracy;
  std::string text;
  h.app->host.save_file = [&](const std::string&, const std::string& bytes) { text = bytes; };
  h.frames(3);
  for (const char* width : {"84", "174"}) {
    h.press("figure");
    h.press(std::string(width) + " mm wide");
    h.frames(2);
    EXPECT_NE(text.find(std::string("width=\"") + width + "mm\""), std::string::npos);
  }
}

TEST(Figure, EscapesTheTextsOfAScene) {
  Headless h;
  auto scene = std::make_shared<Scene>(*h.app->library.scenes().front());
  scene->title = "<script>alert(1)</script> & \"quoted\"";
  h.app->run(scene);
  h.app->session.pause();
  h.frames(2);
  const SavedFigure figure = save_figure(h, plots_of_run(h));
  EXPECT_EQ(figure.text.find("<script"), std::string::npos);
  EXPECT_NE(figure.text.find("<title>&lt;script&gt;"), std::string::npos);
}

}  // namespace
}  // namespace substep
