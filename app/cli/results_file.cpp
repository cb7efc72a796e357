#include "app/cli/results_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>

#include "app/cli/message.hpp"
#include "core/io/json_text.hpp"
#include "core/io/result.hpp"

namespace substep::cli {
namespace {

void tell(const std::string& path, const std::string& what) {
  complain("%s: %s", path.c_str(), what.c_str());
}

void tell(const std::string& path, std::size_t line, const Problems& problems) {
  for (const Problem& problem : problems) {
    complain("%s:%zu: %s", path.c_str(), line, to_string(problem).c_str());
  }
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

/// The part of a result that must be equal for equal experiments: all but the times.
std::string without_timing(const std::string& line) {
  Json json = Json::parse(line, nullptr, false);
  if (json.is_object()) json.erase("timing");
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

bool read_results(const std::string& path, const std::string& text,
                  std::map<std::string, std::string>& lines, std::vector<std::string>& order) {
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    Problems problems;
    const auto json = parse_json(line, problems);
    if (json && json->is_object() && json->contains("format")) {
      check_results_header(line, problems);
      if (problems.empty()) continue;
    }
    const auto id = json && problems.empty() ? result_id(*json, problems) : std::nullopt;
    if (!id) {
      tell(path, number, problems);
      return false;
    }
    const auto [entry, is_new] = lines.emplace(*id, line);
    if (is_new) {
      order.push_back(*id);
    } else if (without_timing(entry->second) != without_timing(line)) {
      tell(path, "line " + std::to_string(number) + ": another result of experiment " + *id +
                     " differs; were they computed by different versions?");
      return false;
    }
  }
  return true;
}

ResultsFile::~ResultsFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool ResultsFile::take_lock() {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    tell(path_, std::strerror(errno));
    return false;
  }
  struct stat about {};
  if (::fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) {
    tell(path_, "not a regular file");
    return false;
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    tell(path_, "another sweep is writing it");
    return false;
  }
  return true;
}

bool ResultsFile::read() {
  std::string text;
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
  // The truncated line of a killed program, without a line feed; it begins with our header or a
  // part of it.
  const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
  const std::string header = results_header();
  if (whole == 0 && text != header.substr(0, text.size())) {
    tell(path_, "not a results file of substep; it is unchanged");
    return false;
  }
  if (whole > 0) {
    Problems problems;
    check_results_header(text.substr(0, text.find('\n')), problems);
    tell(path_, 1, problems);
    if (!problems.empty() || !read_results(path_, text.substr(0, whole), lines_, order_)) {
      tell(path_, "not a results file of substep, or damaged; it is unchanged");
      return false;
    }
  }
  if (whole < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) {
    tell(path_, std::strerror(errno));
    return false;
  }
  return whole > 0 || write(header);
}

bool ResultsFile::open(const std::string& path) {
  path_ = path;
  return take_lock() && read();
}

bool ResultsFile::write(const std::string& text) {
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  if (write_all(descriptor_, text)) return true;
  const int error = errno;
  // Removes a partial line. Truncation needs no disk space.
  if (::ftruncate(descriptor_, before) != 0) {
    // The next reader removes the partial line.
  }
  tell(path_, std::string(std::strerror(error)) + "; the previous results are kept");
  return false;
}

bool ResultsFile::append(const std::string& id, const Json& result) {
  const std::string line = result.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!write(line + '\n')) return false;
  if (lines_.emplace(id, line).second) order_.push_back(id);
  return true;
}

bool ResultsFile::finish(const std::vector<std::string>& order) {
  std::vector<std::string> ids;
  std::set<std::string> known;
  const auto take = [&](const std::vector<std::string>& list) {
    for (const std::string& id : list) {
      if (lines_.contains(id) && known.insert(id).second) ids.push_back(id);
    }
  };
  take(order);
  take(order_);
  if (ids == order_) return true;
  std::string text = results_header();
  for (const std::string& id : ids) text += lines_.at(id) + '\n';
  const std::string temporary = path_ + ".new";
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const bool written = descriptor >= 0 && write_all(descriptor, text) && ::fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!written || std::rename(temporary.c_str(), path_.c_str()) != 0) {
    tell(path_, "not sorted: " + std::string(std::strerror(written ? errno : error)));
    ::unlink(temporary.c_str());
    return false;
  }
  order_ = ids;
  return true;
}

std::vector<Json> ResultsFile::results() const {
  std::vector<Json> all;
  for (const std::string& id : order_) all.push_back(Json::parse(lines_.at(id), nullptr, false));
  return all;
}

}  // namespace substep::cli
