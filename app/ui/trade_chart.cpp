#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/trade_text.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/lab/axes.hpp"
#include "core/lab/fair_trade.hpp"

namespace substep::ui {
namespace {

constexpr float kTop = 20.0F;          // above the rows: the name of the line
constexpr float kLoadLine = 18.0F;     // the name of a load
constexpr float kBar = 16.0F;          // height of a bar with its gap
constexpr float kBetweenLoads = 8.0F;  // between loads
constexpr float kFigures = 104.0F;     // N and the error, on the right

void policy_row(const Look& look, Accuracy& accuracy) {
  constexpr std::array<Choice, 2> kTradePolicies{
      {{"frame", "Under every load that was run"},
       {"sub-step", "Follows a sudden load at once; under the scene's own load only"}}};
  choose(look, "Choose N every", kTradePolicies, accuracy.trade_policy,
         "When the number of sub-steps is set");
}

void alpha_row(const Look& look, Accuracy& accuracy) {
  const std::vector<double>& alphas = accuracy.trade().alphas;
  std::vector<std::string> names;
  for (const double alpha : alphas) names.push_back(plain_number(alpha));
  std::vector<Choice> choices;
  for (const std::string& name : names) {
    choices.push_back({name.c_str(), "Stability threshold of adaptive sub-stepping (Eq. 5)"});
  }
  const auto shown = std::find(alphas.begin(), alphas.end(), accuracy.trade().alpha);
  auto current = static_cast<int>(shown - alphas.begin());
  if (segmented_row(look, "Alpha", choices, current, "Of adaptive sub-stepping")) {
    accuracy.trade_alpha = alphas[static_cast<std::size_t>(current)];
  }
}

/// A bar with its figures, and the run that it starts.
struct Bar {
  const Result* result = nullptr;  // null if no N that ran is enough
  double certain = 0.0;            // lower bound of the sub-steps per frame
  double most = 0.0;               // upper bound
  bool open = false;               // none is known
  std::string n;
  ImU32 color = 0;
  const char* name = "";
};

Bar adaptive_bar(const Theme& t, const TradeRow& row) {
  return {row.adaptive,
          row.n(),
          row.n(),
          false,
          row.adaptive->metrics.holds ? coarse_number(row.n()) : "fails",
          row.adaptive->metrics.holds ? curve_style(t, row.adaptive->experiment.settings).color
                                      : t.orange,
          "Adaptive sub-steps"};
}

Bar constant_bar(const Theme& t, const TradeRow& row, int most_n) {
  Bar bar{row.constant, 0.0, 0.0, false, "", t.grey, "Smallest constant N that is as accurate"};
  if (row.constant == nullptr) {
    bar.certain = bar.most = std::max(row.too_few, most_n);
    bar.open = true;
    bar.n = "> " + plain_number(bar.most);
    return bar;
  }
  const int n = row.constant->experiment.settings.n;
  bar.certain = std::min(row.too_few + 1, n);
  bar.most = n;
  bar.n = bar.certain < bar.most ? plain_number(bar.certain) + "–" + plain_number(bar.most)
                                 : plain_number(bar.most);
  return bar;
}

class Chart {
 public:
  Chart(const Look& look, const Accuracy& accuracy, const FairTrade& trade, float width)
      : look_(look), accuracy_(accuracy), trade_(trade), corner_(ImGui::GetCursorScreenPos()) {
    room_ = width - kFigures;
    for (const TradeRow& row : trade.rows) {
      most_ = std::max({most_, row.n(), constant_bar(*look.theme, row, trade.most_n).most});
    }
    if (shows_line()) most_ = std::max(most_, line());
    width_ = width;
  }

  std::optional<std::size_t> draw() {
    y_ = corner_.y;
    if (shows_line()) y_ += kTop;
    for (const TradeRow& row : trade_.rows) draw_row(row);
    if (shows_line()) name_line();
    ImGui::SetCursorScreenPos({corner_.x, y_});
    ImGui::Dummy({width_, 1.0F});
    return chosen_;
  }

 private:
  [[nodiscard]] bool shows_line() const { return trade_.rows.size() > 1 && trade_.holds(); }
  [[nodiscard]] double line() const { return trade_.for_all ? *trade_.for_all : trade_.most_n; }
  [[nodiscard]] float x_of(double n) const {
    return corner_.x + room_ * static_cast<float>(n / most_);
  }

  void draw_row(const TradeRow& row) {
    const Theme& t = *look_.theme;
    if (trade_.rows.size() > 1) {
      const std::string name = plain_number(row.load) + " × load, mass ratio " +
                               plain_number(row.load * mass_ratio(*accuracy_.scene()));
      draw_text(look_.fonts.small, {corner_.x, y_}, t.dim, name);
      y_ += kLoadLine;
    }
    const float top = y_;
    draw_bar(adaptive_bar(t, row), row);
    draw_bar(constant_bar(t, row, trade_.most_n), row);
    if (shows_line()) {  // the constant N that serves all loads
      const float x = std::round(x_of(line()));
      ImGui::GetWindowDrawList()->AddLine({x, top}, {x, y_}, t.text, 1.0F);
    }
    y_ += kBetweenLoads;
  }

  void draw_bar(const Bar& bar, const TradeRow& row) {
    const Theme& t = *look_.theme;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 min(corner_.x, y_);
    const ImVec2 max(corner_.x + width_, y_ + kBar);
    const float end = bar.open ? corner_.x + room_ : std::max(x_of(bar.most), min.x + 2.0F);
    draw.AddRectFilled({min.x, min.y + 2.0F}, {end, max.y - 2.0F}, fade(bar.color, 0.4F), 2.0F);
    draw.AddRectFilled({min.x, min.y + 2.0F},
                       {std::max(x_of(bar.certain), min.x + 2.0F), max.y - 2.0F}, bar.color, 2.0F);
    draw_text(look_.fonts.small, {corner_.x + room_ + 8.0F, min.y}, t.text, bar.n);
    if (const auto error = error_of_bar(bar)) {
      draw_text_before(look_.fonts.small, {max.x, min.y}, t.dim, error_text(*error, trade_.axis));
    }
    y_ += kBar;
    if (bar.result == nullptr) return;
    const auto index = static_cast<std::size_t>(bar.result - accuracy_.results().data());
    ImGui::SetCursorScreenPos(min);
    ImGui::PushID(static_cast<int>(index));
    if (marked_button("bar", {width_, kBar}, std::to_string(index), "trade")) chosen_ = index;
    ImGui::PopID();
    draw_focus(look_);
    if (ImGui::IsItemHovered()) read_bar(bar, row);
  }

  [[nodiscard]] std::optional<double> error_of_bar(const Bar& bar) const {
    return bar.result != nullptr && bar.result->metrics.holds ? error_of(*bar.result, trade_.axis)
                                                              : std::nullopt;
  }

  void read_bar(const Bar& bar, const TradeRow& row) const {
    const Theme& t = *look_.theme;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    std::vector<ReadOutLine> lines{{bar.name, t.text, true}};
    const bool adaptive = bar.result == row.adaptive;
    lines.push_back({adaptive ? "alpha = " + plain_number(trade_.alpha) +
                                    ", N = " + coarse_number(row.n()) + " on average"
                              : "N = " + trade_number(row, trade_.most_n),
                     t.dim});
    if (const auto error = error_of_bar(bar)) {
      lines.push_back(
          {std::string(axis_name(trade_.axis)) + ": " + error_text(*error, trade_.axis), t.dim});
    } else {
      lines.push_back({verdict_words(bar.result->metrics.verdict), t.orange});
    }
    lines.push_back({"Click to run it", t.accent});
    read_out(look_, lines);
  }

  void name_line() const {
    const std::string text =
        "one N for all loads: " + std::string(trade_.for_all ? "" : "> ") + plain_number(line());
    const float w = text_size(look_.fonts.small, text).x;
    const float x = std::clamp(x_of(line()) - 0.5F * w, corner_.x, corner_.x + width_ - w);
    draw_text(look_.fonts.small, {x, corner_.y}, look_.theme->text, text);
  }

  const Look& look_;
  const Accuracy& accuracy_;
  const FairTrade& trade_;
  ImVec2 corner_;
  float width_ = 0.0F;
  float room_ = 0.0F;  // for the bars
  double most_ = 1.0;  // sub-steps of the longest bar
  float y_ = 0.0F;
  std::optional<std::size_t> chosen_;
};

void legend(const Look& look, const FairTrade& trade) {
  const Theme& t = *look.theme;
  const auto entry = [&](ImU32 color, const std::string& name) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 4.0F}, {at.x + 12.0F, at.y + 12.0F},
                                              color, 2.0F);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 20.0F);
    label(look.fonts.small, t.dim, name);
  };
  entry(adaptive_bar(t, trade.rows.front()).color,
        "Adaptive, alpha = " + plain_number(trade.alpha) + ": mean sub-steps per frame");
  entry(t.grey, std::string("Smallest constant N ") + as_accurate(trade) +
                    ", found by trial; light: it is in this range");
  const std::string axis = axis_name(trade.axis);  // each error has its own unit
  label(look.fonts.small, t.dim,
        "On the right: N, and the " + axis.substr(0, axis.find(" [")) + ".");
}

}  // namespace

void trade_head(const Look& look, Accuracy& accuracy) {
  const bool known = !accuracy.trade().rows.empty();
  const std::string text = known ? trade_text(accuracy.trade()) : "No runs to compare yet.";
  label(look.fonts.regular, look.theme->text, text);
  space(6.0F);
  policy_row(look, accuracy);
  if (known) alpha_row(look, accuracy);
  space(4.0F);
}

std::optional<std::size_t> trade_chart(const Look& look, Accuracy& accuracy, float width) {
  const FairTrade& trade = accuracy.trade();
  if (trade.rows.empty()) return std::nullopt;
  const auto chosen = Chart(look, accuracy, trade, width).draw();
  space(4.0F);
  legend(look, trade);
  return chosen;
}

}  // namespace substep::ui
