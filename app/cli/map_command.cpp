#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/map_picture.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/within.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

/// A parameter that makes a scene harder, and the scenes that it generates.
struct Axis {
  const char* name;
  const char* label;
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
       "mass of the box on 25 links, relative to a link",
       {1, 10, 100, 1e3, 1e4, 1e5, 1e6},
       [](double m) { return lasting(rope_of_n({.end_mass = m}), 5.0); }},
      {"chain_length",
       "links of 1 kg carrying 1,000 kg",
       {5, 10, 25, 50, 100, 200, 400},
       [](double n) { return lasting(rope_of_n({.n = static_cast<int>(n)}), 4.0); }},
      {"stack_height",
       "layers under 10 t, balls displaced by up to 2 mm",
       {1, 2, 3, 5, 8, 10, 15},
       [](double n) {
         return lasting(heavy_stack({.layers = static_cast<int>(n), .stress = true}), 5.0);
       }},
  };
}

std::string line_of(const MapCell& c) {
  const Settings& settings = c.run->cell.settings;
  const Metrics& m = c.run->metrics;
  return c.map + ',' + number_text(c.value) + ',' + number_text(settings.alpha) + ',' +
         std::string(name_of(settings.solver)) + ',' + (m.holds ? "1," : "0,") +
         number_text(c.run->time) + ',' + std::to_string(m.work.n_median) + ',' +
         std::to_string(m.work.n_max) + ',' + std::to_string(m.work.substeps) + '\n';
}

struct MapOptions {
  std::string out = "-";
  std::string picture;
  double seconds = 0.0;  // 0: the axis's own duration
  int jobs = 0;
};

int run_map(const MapOptions& options) {
  Output out;
  Output picture;
  if (!out.open(options.out) || !picture.open(options.picture)) return kBadInput;
  std::vector<Check> checks;
  std::vector<MapCell> cells;
  for (const Axis& axis : axes()) {
    for (const double value : axis.values) {
      Scene made = axis.scene(value);
      if (options.seconds > 0.0) made.criteria.duration = options.seconds;
      const auto scene = std::make_shared<const Scene>(std::move(made));
      for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
        for (const double alpha : kAlphas) {
          Settings settings = scene->settings;
          settings.mode = Mode::kAdaptive;
          settings.solver = solver;
          settings.alpha = alpha;
          settings.n_max = 1000;  // so that alpha determines N
          checks.push_back({.scene = scene, .cell = {settings, {}}});
          cells.push_back({axis.name, axis.label, value});
        }
      }
    }
  }
  out.write("map,value,alpha,solver,holds,seconds,n_median,n_max,substeps\n");
  out.keep_if_ended();
  const bool complete = run_checks(
      checks, options.jobs,
      [&](const Check& check) {
        MapCell& cell = cells[static_cast<std::size_t>(&check - checks.data())];
        cell.run = &check;
        out.write(line_of(cell));
      },
      cancel_on_signal());
  if (!complete) {
    say_cancelled("; the completed runs are in the table, the picture is not written");
    return out.close() ? kCancelled : kBadInput;
  }
  if (!out.close()) return kBadInput;  // then the checks ended early and cells have no run
  if (picture.is_open()) picture.write(map_picture(cells));
  return picture.close() ? kOk : kBadInput;
}

}  // namespace

void add_map(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand(
      "map", "Map where adaptive sub-steps hold, by alpha: mass ratio, chain length, stack height");
  command->add_option("--out", options->out, "the table as CSV; - for standard output")
      ->check(named());
  command->add_option("--picture", options->picture, "the maps as SVG")->check(named());
  command
      ->add_option("--seconds", options->seconds,
                   "simulated time of each run; default: that of the shipped map, 4 or 5 s")
      ->check(within(0.01, 3600.0));
  command->add_option("--jobs", options->jobs, "parallel runs; 0: one per processor")
      ->check(whole(0, 1000));
  command->footer(
      "Columns: what is varied and its value; alpha; solver; whether it holds; how long it ran "
      "[s];\n"
      "sub-steps per frame, their median and most, and all of them.");
  command->callback([options, &exit_code] {
    keep_apart({{"--out", options->out}, {"--picture", options->picture}}, {});
    exit_code = run_map(*options);
  });
}

}  // namespace substep::cli
