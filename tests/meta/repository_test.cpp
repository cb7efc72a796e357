// Rules of the repository, checked in its sources: module dependencies, platform conditionals,
// names of tests, and no references to one machine.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SUBSTEP_SOURCE_DIR;

/// Text files of the repository, relative to its root, without those that git ignores.
std::vector<std::string> files() {
  static const std::set<std::string> skipped{".git", ".cache", "build", "node_modules"};
  static const std::set<std::string> binary{".png", ".jpg", ".ttf", ".ico", ".woff2"};
  std::vector<std::string> found;
  for (auto it = fs::recursive_directory_iterator(kRoot); it != fs::end(it); ++it) {
    if (skipped.contains(it->path().filename().string())) {
      if (it->is_directory()) it.disable_recursion_pending();  // .git is a file in a worktree
    } else if (it->is_regular_file() && !binary.contains(it->path().extension().string())) {
      found.push_back(it->path().lexically_relative(kRoot).generic_string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream stream(kRoot / file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool is_cpp(const std::string& file) { return file.ends_with(".hpp") || file.ends_with(".cpp"); }

/// Every place where a line of a file matches, as "file:line: text".
template <class Keep>
std::string places(const std::regex& pattern, Keep keep) {
  std::ostringstream out;
  for (const std::string& file : files()) {
    if (!keep(file)) continue;
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (std::regex_search(lines[i], pattern)) {
        out << file << ':' << i + 1 << ": " << lines[i] << '\n';
      }
    }
  }
  return out.str();
}

/// Allowed includes of each module of core/, besides itself.
const std::map<std::string, std::set<std::string>>& allowed_modules() {
  static const auto allowed = [] {
    const std::vector<std::string> order{"math",   "model",    "forces", "collision", "constraints",
                                         "solver", "stepping", "sim",    "lab"};
    std::map<std::string, std::set<std::string>> map;
    for (auto it = order.begin(); it != order.end(); ++it) map[*it] = {order.begin(), it};
    map["io"] = {"math", "model", "forces", "sim", "lab"};
    map["import"] = {"math", "model", "io"};
    return map;
  }();
  return allowed;
}

/// The modules that a file of core/ includes against the order, e.g. "core/math/a.hpp includes
/// sim".
std::string arrows_back(const std::string& file, const std::vector<std::string>& lines) {
  static const std::regex include(R"re(^\s*#\s*include\s+["<]([^">]+)[">])re");
  const auto module_of = [](const std::string& path) {
    const std::string rest = path.substr(std::string("core/").size());
    return rest.substr(0, rest.find('/'));
  };
  const std::string own = module_of(file);
  std::ostringstream out;
  for (const std::string& line : lines) {
    std::smatch match;
    if (!std::regex_search(line, match, include)) continue;
    const std::string target = match[1];
    for (const char* outside : {"app/", "web/", "tests/"}) {
      if (target.starts_with(outside)) out << file << " includes " << target << '\n';
    }
    if (!target.starts_with("core/")) continue;
    const std::string other = module_of(target);
    const auto allowed = allowed_modules().find(own);
    if (allowed == allowed_modules().end()) {
      out << file << " is in no known module\n";
    } else if (other != own && !allowed->second.contains(other)) {
      out << file << " includes " << target << '\n';
    }
  }
  return out.str();
}

TEST(ModuleOrder, NoModuleIncludesAgainstTheOrder) {
  int seen = 0;
  for (const std::string& file : files()) {
    if (!file.starts_with("core/") || !is_cpp(file)) continue;
    EXPECT_EQ(arrows_back(file, lines_of(file)), "");
    ++seen;
  }
  EXPECT_GT(seen, 10);
}

TEST(ModuleOrder, AnIncludeAgainstTheOrderIsDetected) {
  const std::vector<std::string> lines{R"(#include "core/sim/simulator.hpp")"};
  EXPECT_NE(arrows_back("core/math/types.hpp", lines), "");
  EXPECT_NE(arrows_back("core/solver/bpp.cpp", lines), "");
  EXPECT_EQ(arrows_back("core/lab/verdict.hpp", lines), "");
  EXPECT_EQ(arrows_back("core/sim/report.hpp", lines), "");
  EXPECT_NE(arrows_back("core/sim/report.hpp", {R"(#include "app/ui/app.hpp")"}), "");
}

TEST(ModuleOrder, CoreIncludesNoGraphics) {
  const std::regex graphics(R"(#\s*include\s+["<](imgui|GLFW|epoxy|GL/|GLES|emscripten))");
  EXPECT_EQ(places(graphics, [](const auto& file) { return file.starts_with("core/"); }), "");
}

TEST(Platform, ConditionalsAreOnlyInTheWebShellAndTheShaderHeader) {
  const std::regex conditional(R"(^\s*#.*(__EMSCRIPTEN__|_WIN32|__APPLE__|__linux__))");
  EXPECT_EQ(places(conditional,
                   [](const std::string& file) {
                     const bool shader = file.starts_with("app/render/") &&
                                         file.find("shader") != std::string::npos;
                     return is_cpp(file) && !file.starts_with("web/") && !shader;
                   }),
            "");
}

TEST(Repository, HasNoPathOfOneMachine) {
  // Home folders and working copies of one person or machine. The names are concatenated here so
  // that this file does not match.
  const std::regex path(std::string("(^|[^A-Za-z0-9_.])/(ho") + "me|wo" + "rk|ro" + "ot|Us" +
                        "ers)/[A-Za-z0-9_.]");
  EXPECT_EQ(places(path, [](const std::string&) { return true; }), "");
}

TEST(Repository, TextEndsInANewlineAndHasNoTrailingBlanks) {
  const auto keep = [](const std::string& file) {
    return is_cpp(file) || file.ends_with(".md") || file.ends_with(".txt") ||
           file.ends_with(".cmake") || file.ends_with(".mjs") || file.ends_with(".json");
  };
  EXPECT_EQ(places(std::regex(R"([ \t\r]+$)"), keep), "");
  for (const std::string& file : files()) {
    if (!keep(file)) continue;
    std::ifstream stream(kRoot / file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(text.empty() || text.back() == '\n') << file << " does not end in a newline";
  }
}

TEST(Repository, HeadersAreIncludedOnce) {
  for (const std::string& file : files()) {
    if (!file.ends_with(".hpp")) continue;
    const std::vector<std::string> lines = lines_of(file);
    EXPECT_NE(std::find(lines.begin(), lines.end(), "#pragma once"), lines.end())
        << file << " has no #pragma once";
  }
}

TEST(Repository, EverySceneHasGoldenLines) {
  std::set<std::string> golden;
  for (const char* file : {"golden_hashes.txt", "golden_work.txt"}) {
    for (const std::string& line : lines_of(std::string("tests/reference/") + file)) {
      golden.insert(std::string(file) + " " + line.substr(0, line.find(' ')));
    }
  }
  for (const std::string& file : files()) {
    if (!file.starts_with("scenes/") || !file.ends_with(".json")) continue;
    if (file == "scenes/scene.schema.json" || file.starts_with("scenes/generator/")) continue;
    const std::string name = fs::path(file).stem().string();
    EXPECT_TRUE(golden.contains("golden_hashes.txt " + name)) << name;
    EXPECT_TRUE(golden.contains("golden_work.txt " + name)) << name;
  }
}

TEST(Repository, TheReadmesExampleIsTheOneThatIsBuilt) {
  std::ifstream readme_file(kRoot / "core/README.md");
  const std::string readme{std::istreambuf_iterator<char>(readme_file), {}};
  std::ifstream example_file(kRoot / "tests/install/consumer/pendulum.cpp");
  const std::string example{std::istreambuf_iterator<char>(example_file), {}};
  ASSERT_FALSE(example.empty());
  EXPECT_NE(readme.find("```cpp\n" + example + "```\n"), std::string::npos)
      << "core/README.md does not show tests/install/consumer/pendulum.cpp as it is";
}

TEST(Tests, AreNamedSubjectAndLaw) {
  const std::regex test(R"(^(TYPED_)?TEST(_[FP])?\()");
  const std::regex named(R"(^(TYPED_)?TEST(_[FP])?\(([A-Z][A-Za-z0-9]*), ([A-Z][A-Za-z0-9]*)\))");
  for (const std::string& file : files()) {
    if (!file.starts_with("tests/") || !is_cpp(file)) continue;
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!std::regex_search(lines[i], test)) continue;
      const std::string next = i + 1 < lines.size() ? lines[i + 1] : "";
      std::string joined = lines[i];  // a long name is wrapped onto the next line
      if (lines[i].ends_with(',')) joined += " " + next.substr(next.find_first_not_of(' '));
      EXPECT_TRUE(std::regex_search(joined, named))
          << file << ':' << i + 1 << ": name it TEST(Subject, LawThatHolds): " << joined;
    }
  }
}

}  // namespace
