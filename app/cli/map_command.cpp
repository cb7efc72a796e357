#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/checks.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/output.hpp"
#include "core/io/number_text.hpp"
#include "core/model/names.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

/// What makes a scene harder, and the scenes that it makes.
struct Axis {
  const char* name;
  std::vector<double> values;
  std::function<Scene(double)> scene;
};

const std::vector<double> kAlphas{1.0, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02};

Scene lasting(Scene scene, double seconds) {
  scene.criteria.duration = seconds;
  return scene;
}

std::vector<Axis> axes() {
  using namespace scenes;
  return {
      {"mass_ratio",
       {1, 10, 100, 1e3, 1e4, 1e5, 1e6},
       [](double m) { return lasting(rope_of_n({.end_mass = m}), 5.0); }},
      {"chain_length",
       {5, 10, 25, 50, 100, 200, 400},
       [](double n) { return lasting(rope_of_n({.n = static_cast<int>(n)}), 4.0); }},
      {"stack_height",
       {1, 2, 3, 5, 8, 10, 15},
       [](double n) {
         return lasting(heavy_stack({.layers = static_cast<int>(n), .stress = true}), 5.0);
       }},
  };
}

struct Cell {
  const char* axis;
  double value;
};

void write_line(Output& out, const Cell& cell, const Check& check) {
  const Metrics& m = check.metrics;
  out.write(std::string(cell.axis) + ',' + number_text(cell.value) + ',' +
            number_text(check.cell.settings.alpha) + ',' +
            std::string(name_of(check.cell.settings.solver)) + ',' + (m.holds ? "1," : "0,") +
            number_text(check.time) + ',' + std::to_string(m.work.n_median) + ',' +
            std::to_string(m.work.n_max) + ',' + std::to_string(m.work.substeps) + '\n');
}

int run_map(const std::string& path, int jobs) {
  Output out;
  if (!out.open(path)) return kBadInput;
  std::vector<Check> checks;
  std::vector<Cell> cells;
  for (const Axis& axis : axes()) {
    for (const double value : axis.values) {
      const auto scene = std::make_shared<const Scene>(axis.scene(value));
      for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
        for (const double alpha : kAlphas) {
          Settings settings = scene->settings;
          settings.mode = Mode::kAdaptive;
          settings.solver = solver;
          settings.alpha = alpha;
          settings.n_max = 1000;  // it is alpha that decides
          checks.push_back({.scene = scene, .cell = {settings, {}}});
          cells.push_back({axis.name, value});
        }
      }
    }
  }
  out.write("map,value,alpha,solver,holds,seconds,n_median,n_max,substeps\n");
  run_checks(checks, jobs, [&](const Check& check) {
    write_line(out, cells[static_cast<std::size_t>(&check - checks.data())], check);
  });
  return out.close() ? kOk : kBadInput;
}

}  // namespace

void add_map(CLI::App& app, int& exit_code) {
  struct Options {
    std::string out = "-";
    int jobs = 0;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "map", "Where adaptive sub-steps hold, by alpha: mass ratio, chain length, stack height");
  command->add_option("--out", options->out, "the table as CSV; - for standard output");
  command->add_option("--jobs", options->jobs, "runs at a time; 0: one for each processor")
      ->check(CLI::Range(0, 1000));
  command->footer(
      "Columns: what is varied and its value; alpha; solver; whether it holds; how long it ran "
      "[s];\n"
      "sub-steps a frame, their median and most, and all of them.");
  command->callback([options, &exit_code] { exit_code = run_map(options->out, options->jobs); });
}

}  // namespace substep::cli
