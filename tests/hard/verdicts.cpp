// The runner of `substep check` for any build, Node.js included:
//   verdicts FOLDER_OF_SCENES [--each K] SCENE...
// Prints a line per run with its verdict, work and hash, identical in every build; of each K-th run
// of all scenes only. Returns 1 if a run differs from its scene's table.

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/checks.hpp"
#include "core/io/scene_reader.hpp"

int main(int argc, char** argv) {
  using namespace substep;
  const bool samples = argc > 3 && std::string_view(argv[2]) == "--each";
  const int each = samples ? std::atoi(argv[3]) : 1;
  const int first = samples ? 4 : 2;
  if (argc <= first || each < 1) {
    std::fprintf(stderr, "usage: %s FOLDER_OF_SCENES [--each K] SCENE...\n", argv[0]);
    return 2;
  }
  std::vector<cli::Check> checks;
  int cells = 0;
  for (int i = first; i < argc; ++i) {
    const SceneResult read = read_scene_file(std::string(argv[1]) + "/" + argv[i] + ".json");
    for (const Problem& problem : read.problems) {
      std::fprintf(stderr, "%s: %s\n", argv[i], to_string(problem).c_str());
    }
    if (!read.scene) return 2;
    for (VerdictCell& cell : verdict_table(*read.scene)) {
      if (++cells % each != 0) continue;
      checks.push_back({.scene = read.scene, .cell = std::move(cell)});
    }
  }
  int unexpected = 0;
  cli::run_checks(checks, 1, [&](const cli::Check& check) {
    if (!check.judgement.as_expected) ++unexpected;
    std::printf("%-6s %s %s: %s, %lld sub-steps, %lld flops, %016" PRIx64 "\n",
                check.judgement.as_expected ? "ok" : "FAILED", check.scene->name.c_str(),
                cell_name(check.cell.settings).c_str(), check.metrics.verdict.c_str(),
                static_cast<long long>(check.metrics.work.substeps),
                static_cast<long long>(check.metrics.work.flops), check.metrics.hash);
    std::fflush(stdout);
  });
  std::printf("%zu runs: %d not as expected\n", checks.size(), unexpected);
  return unexpected == 0 ? 0 : 1;
}
