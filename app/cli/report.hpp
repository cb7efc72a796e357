#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/lab/experiment.hpp"

namespace substep::cli {

/// Writes report.html into the folder: all pictures of these results in one self-contained file.
/// @return false, with a message on stderr, if it cannot be written
/// @param scene may be null
bool write_sweep_report(const std::filesystem::path& folder,
                        const std::shared_ptr<const Scene>& scene, const std::vector<Json>& results,
                        bool quiet);

/// Writes a page in the report's format (read by app/report/report.mjs) to a file.
bool write_page(const std::filesystem::path& path, const Json& data, bool quiet);

/// A curve over time.
struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::string note;     // after the name: "fails at 0.35 s"
  bool failed = false;  // it ends with a cross
  bool dashed = false;
  bool step = false;  // piecewise constant
};
Json chart_json(const std::string& title, const std::string& note, const std::string& x,
                const std::string& y, bool log, const std::vector<Curve>& curves);

}  // namespace substep::cli
