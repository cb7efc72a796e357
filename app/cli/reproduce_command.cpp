#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/progress_line.hpp"
#include "app/cli/report.hpp"
#include "app/cli/reproduction.hpp"
#include "app/cli/within.hpp"

namespace substep::cli {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
  std::string out = "reproduction";
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool quiet = false;
};

struct Part {
  const char* name;
  Card (*card)(int jobs);
};
constexpr Part kParts[] = {{"Fig. 2", substeps_over_time},
                           {"Fig. 3", energy_over_time},
                           {"Fig. 4", heavy_stack},
                           {"explosion", explosion},
                           {"alpha", alpha_law},
                           {"Gauss-Seidel", gauss_seidel},
                           {"bridge", bridge},
                           {"taller stack", taller_stack},
                           {"cap", capped}};

const char* name_of(Card::Outcome outcome) {
  switch (outcome) {
    case Card::Outcome::kAgrees:
      return "agrees";
    case Card::Outcome::kDiffers:
      return "differs";
    case Card::Outcome::kFails:
      break;
  }
  return "fails";
}

Json page_of(const std::vector<Card>& cards) {
  Json list = Json::array();
  Json charts = Json::array();
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const Card& card = cards[i];
    list.push_back({{"title", card.title},
                    {"paper", card.paper},
                    {"here", card.here},
                    {"why", card.why},
                    {"command", card.command},
                    {"verdict", name_of(card.outcome)}});
    for (Json chart : card.charts) {
      chart["card"] = i;
      charts.push_back(std::move(chart));
    }
  }
  Json data;
  data["title"] = "The paper's figures and claims";
  data["about"] = Json::array(
      {"Giles and Andrews, \"Adaptive Sub-stepping for Constrained Rigid Body Simulations\", MIG "
       "'24, and the results of this program. Every number was computed when this page was "
       "written."});
  data["cards"] = std::move(list);
  data["charts"] = std::move(charts);
  return data;
}

int run(const ReproduceOptions& options) {
  const fs::path folder = options.out;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    complain("%s: %s", folder.string().c_str(), error.message().c_str());
    return kBadInput;
  }
  ProgressLine progress(!options.quiet && stderr_is_terminal());
  std::vector<Card> cards;
  for (const Part& part : kParts) {
    if (cancel_on_signal()) break;
    progress.show(std::to_string(cards.size() + 1) + " of " + std::to_string(std::size(kParts)) +
                  ": " + part.name);
    cards.push_back(part.card(options.jobs));
  }
  progress.clear();
  if (cancel_on_signal()) {
    say_cancelled("; nothing was written");
    return kCancelled;
  }
  bool all = true;
  for (const Card& card : cards) {
    all = all && card.outcome != Card::Outcome::kFails;
    if (!options.quiet) {
      say(stdout, "%-8s %s\n         %s\n", name_of(card.outcome), card.title.c_str(),
          card.here.c_str());
    }
  }
  if (!write_page(folder / "report.html", page_of(cards), options.quiet)) return kBadInput;
  return all ? kOk : kUnexpectedVerdict;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App* command = app.add_subcommand(
      "reproduce", "Recompute the paper's figures and claims and compare them with the paper");
  command->add_option("--out", options->out, "folder for report.html")->check(named());
  command->add_option("--jobs", options->jobs, "threads")->check(whole(1, 1024));
  command->add_flag("--quiet", options->quiet, "no progress, no summary");
  command->footer("Exit code 1 if a result differs from the recorded one.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace substep::cli
