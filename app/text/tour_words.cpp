#include "app/text/tour_words.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "app/text/format.hpp"

namespace substep {
namespace {

// Contains every halving and doubling of alpha = 0.1, ten per decade (Renard's R10).
constexpr std::array<double, 21> kAlphas{0.01, 0.0125, 0.016, 0.02, 0.025, 0.032, 0.04,
                                         0.05, 0.063,  0.08,  0.1,  0.125, 0.16,  0.2,
                                         0.25, 0.32,   0.4,   0.5,  0.63,  0.8,   1.0};
// Four times the mass requires twice the sub-steps.
constexpr std::array<double, 12> kLoads{0.01, 0.02, 0.04, 0.1,  0.2,  0.4,
                                        1.0,  2.0,  4.0,  10.0, 20.0, 40.0};
constexpr int kMostN = 24;

void add_numbers(const Lab& lab, const std::vector<TourPart>& parts, TourWords& words) {
  for (const TourPart& part : parts) {
    if (part.kind == TourPart::Kind::kNumber) words.numbers.push_back(tour_number(lab, part.name));
  }
}

}  // namespace

TourNumber tour_number(const Lab& lab, std::string_view name) {
  const Settings& settings = lab.session.settings();
  if (name == "n" || name == "n_cap") {
    const bool constant = name == "n";
    const int value = constant ? settings.n : settings.n_cap;
    std::vector<double> stops(kMostN);
    std::iota(stops.begin(), stops.end(), 1.0);
    return {std::string(name),
            constant ? "Sub-steps per frame" : "Sub-steps per frame, at most",
            static_cast<double>(value),
            std::to_string(value) + (value == 1 ? " sub-step" : " sub-steps"),
            std::move(stops),
            true};
  }
  if (name == "load") {
    return {"load",
            "Mass of the box",
            lab.load,
            grouped(lab.heaviest_mass()) + " kg",
            {kLoads.begin(), kLoads.end()},
            false};
  }
  return {"alpha",
          "Alpha",
          settings.alpha,
          plain_number(settings.alpha),
          {kAlphas.begin(), kAlphas.end()},
          false};
}

TourWords tour_words(const Lab& lab, std::size_t step, const RunLoop& loop) {
  const TourStep& now = tour_steps()[step];
  TourWords words;
  words.step = step;
  words.count = tour_steps().size();
  words.title = now.title;
  words.text = tour_parts(now.text);
  words.watch = tour_parts(now.watch);
  words.task = tour_parts(now.task);
  for (const auto* parts : {&words.text, &words.watch, &words.task}) {
    add_numbers(lab, *parts, words);
  }
  words.now = fixed(lab.session.state().time, 2) + " s";
  if (lab.session.speed() < 1.0) words.now += ", slow motion";
  const int n = lab.session.report().n_substeps;
  if (n > 0) words.now += "  ·  N = " + std::to_string(n);
  for (const Compare::Run& run : lab.compare.runs()) {
    if (run.report.n_substeps > 0) {
      words.now += ", ghost " + std::to_string(run.report.n_substeps);
    }
  }
  words.reply = now.reply(lab, loop.outcome());
  return words;
}

std::string tour_sentence(const std::vector<TourPart>& parts,
                          const std::vector<TourNumber>& numbers) {
  std::string text;
  for (const TourPart& part : parts) {
    const auto number = std::find_if(numbers.begin(), numbers.end(),
                                     [&](const TourNumber& n) { return n.name == part.name; });
    const bool is_number = part.kind == TourPart::Kind::kNumber && number != numbers.end();
    text += is_number ? number->text : part.text;
  }
  return text;
}

}  // namespace substep
