#include "app/cli/results_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "core/io/result.hpp"

namespace substep::cli {
namespace {

void tell(const std::string& path, const std::string& what) {
  complain("%s: %s", path.c_str(), what.c_str());
}

/// Writes all of it, or returns false with errno set.
bool write_all(int descriptor, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

ResultsFile::~ResultsFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool ResultsFile::take_lock() {
  struct stat about {};
  struct stat named {};
  do {  // another sweep may have replaced the file by a sorted one in between
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      tell(path_, std::strerror(errno));
      return false;
    }
    if (::fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) {
      tell(path_, "not a regular file");
      return false;
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      tell(path_, "another sweep is writing it");
      return false;
    }
  } while (::stat(path_.c_str(), &named) != 0 || named.st_dev != about.st_dev ||
           named.st_ino != about.st_ino);
  return true;
}

void keep_files_apart(const std::filesystem::path& folder, const std::string& results) {
  keep_apart({{"results", (folder / results).string()},
              {"scene.json", (folder / "scene.json").string()},
              {"report.html", (folder / "report.html").string()}},
             {});
}

bool ResultsFile::load(std::string& text) {
  char part[65536];
  for (ssize_t n = 0;
       (n = ::pread(descriptor_, part, sizeof part, static_cast<off_t>(text.size()))) != 0;) {
    if (n < 0) {
      tell(path_, std::strerror(errno));
      return false;
    }
    text.append(part, static_cast<std::size_t>(n));
    if (text.size() > kMostResults) {
      tell(path_, "has more than " + std::to_string(kMostResults) + " bytes");
      return false;
    }
  }
  return true;
}

bool ResultsFile::read() {
  std::string text;
  if (!load(text)) return false;
  const std::size_t size = text.size();
  // A killed program leaves a truncated line without a line feed. An editor may leave others.
  const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
  const std::string end = text.substr(whole);
  const bool has_line = !end.empty() && !is_cut_line(end);
  const std::string header = results_header();
  if (whole == 0 && !has_line && text != header.substr(0, text.size())) {
    tell(path_, "not a results file of substep; it is unchanged");
    return false;
  }
  has_line ? text.push_back('\n') : text.resize(whole);
  if (!text.empty()) {
    Problems problems;
    check_results_header(text.substr(0, text.find('\n')), problems);
    for (const Problem& problem : problems) {
      complain("%s:1: %s", path_.c_str(), to_string(problem).c_str());
    }
    if (!problems.empty() || !results_.read(path_, text)) {
      tell(path_, "not a results file of substep, damaged, or of another scene; it is unchanged");
      return false;
    }
  }
  if (has_line) return write("\n");
  if (whole < size) {
    const auto line = std::to_string(std::count(text.begin(), text.end(), '\n') + 1);
    complain("%s:%s: the last line is cut short; it is removed", path_.c_str(), line.c_str());
    if (::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) {
      tell(path_, std::strerror(errno));
      return false;
    }
  }
  return whole > 0 || write(header);
}

bool ResultsFile::open(const std::string& path, const ResultsScene& scene) {
  path_ = path;
  if (!spares_inputs(path_, true)) return false;
  results_.bind(scene);
  return take_lock() && read();
}

bool ResultsFile::write(const std::string& text) {
  int error = 0;
  {
    const auto committing = commit();
    const off_t before = ::lseek(descriptor_, 0, SEEK_END);
    if (write_all(descriptor_, text)) return true;
    error = errno;
    // Removes a partial line. Truncation needs no disk space.
    if (::ftruncate(descriptor_, before) != 0) {
      // The next reader removes the partial line.
    }
  }
  tell(path_, std::string(std::strerror(error)) + "; the previous results are kept");
  return false;
}

bool ResultsFile::append(const std::string& id, const Json& result) {
  std::string line = result.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!write(line + '\n')) return false;
  results_.add(id, std::move(line));
  return true;
}

bool ResultsFile::finish(const std::vector<std::string>& order) {
  std::vector<std::string> ids;
  std::set<std::string> known;
  const auto take = [&](const std::vector<std::string>& list) {
    for (const std::string& id : list) {
      if (results_.contains(id) && known.insert(id).second) ids.push_back(id);
    }
  };
  take(order);
  take(results_.order());
  if (ids == results_.order()) return true;
  results_.sort(std::move(ids));
  return write_file(path_, results_.text());
}

std::vector<Json> ResultsFile::results() const {
  std::vector<Json> all;
  for (const std::string& id : results_.order()) {
    all.push_back(Json::parse(results_.line(id), nullptr, false));
  }
  return all;
}

}  // namespace substep::cli
