#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/lab/experiment.hpp"

namespace substep::cli {

/// Writes report.html into the folder: every picture of these results in one file that opens
/// without a network. @return false and a message on stderr where it cannot be written
bool write_sweep_report(const std::filesystem::path& folder, const Scene* scene,
                        const std::vector<Json>& results, bool quiet);

/// Writes a page of the report's kind (app/report/report.mjs reads it) to a file.
bool write_page(const std::filesystem::path& path, const Json& data, bool quiet);

/// A curve over time for a page's pictures.
struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::string note;     // behind the name: "fails at 0.35 s"
  bool failed = false;  // it ends with a cross
  bool dashed = false;
  bool step = false;  // constant between its points
};
Json chart_json(const std::string& title, const std::string& note, const std::string& x,
                const std::string& y, bool log, const std::vector<Curve>& curves);

}  // namespace substep::cli
