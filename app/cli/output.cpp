#include "app/cli/output.hpp"

#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>

#include "app/cli/message.hpp"

namespace substep::cli {
namespace {

namespace fs = std::filesystem;

std::optional<struct stat> about(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return found;
}

std::optional<struct stat> about(int descriptor) {
  struct stat found {};
  if (::fstat(descriptor, &found) != 0) return std::nullopt;
  return found;
}

bool same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// The order of locking: g_commit, g_outputs, the mutex of an output.
std::mutex g_commit;
std::mutex g_outputs;       // of the list, and of creating temporary files
Output* g_first = nullptr;  // open outputs

/// A name of a temporary file that a signal handler can read.
struct Temporary {
  enum State : int { kFree, kBeingSet, kThere };
  std::atomic<int> state{kFree};
  char name[PATH_MAX] = {};
};
std::array<Temporary, 64> g_temporaries;  // more than any command has

void remember_temporary(const std::string& name) {
  if (name.size() >= PATH_MAX) return;
  for (Temporary& at : g_temporaries) {
    int free = Temporary::kFree;
    if (!at.state.compare_exchange_strong(free, Temporary::kBeingSet)) continue;
    name.copy(at.name, name.size());
    at.name[name.size()] = '\0';
    at.state = Temporary::kThere;
    return;
  }
}

std::mutex g_mutex_of_inputs;
// By device and number: whether an output that is opened in place may replace the file.
std::map<std::pair<dev_t, ino_t>, bool> g_inputs;

/// The target of a path with all links resolved, even if the file does not exist.
fs::path target_of(const std::string& path, std::error_code& error) {
  constexpr int kMostLinks = 40;  // as on Linux
  fs::path at = path;
  for (int i = 0; i < kMostLinks && fs::is_symlink(at, error); ++i) {
    const fs::path next = fs::read_symlink(at, error);
    if (error) return {};
    at = at.parent_path() / next;  // `next` itself if that is absolute
  }
  error.clear();
  at = fs::absolute(at, error);
  return error ? fs::path() : fs::weakly_canonical(at, error);
}

/// A new name next to the target: only within one folder is the rename atomic.
std::string beside(const fs::path& target) {
  constexpr std::size_t kLongest = 200;  // leaves room within the 255 bytes of a name
  static std::atomic<int> count{0};
  const std::string name = target.filename().string().substr(0, kLongest) + "." +
                           std::to_string(::getpid()) + "." + std::to_string(count++) + ".new";
  return (target.parent_path() / name).string();
}

/// Whether two paths name the same file, or both standard output. False if one is empty, or for a
/// device such as /dev/null, which may have several writers.
bool same_output(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  const bool a_is_standard = is_standard_output(a);
  if (a_is_standard || is_standard_output(b)) return a_is_standard == is_standard_output(b);
  const auto about_a = about(a);
  const auto about_b = about(b);
  if (about_a && S_ISCHR(about_a->st_mode)) return false;
  if (a == b) return true;
  if (about_a && about_b) return same(*about_a, *about_b);
  std::error_code error;
  const fs::path path_a = target_of(a, error);
  if (error) return false;
  const fs::path path_b = target_of(b, error);
  return !error && path_a == path_b;
}

}  // namespace

void protect_input(const std::string& path, bool in_place) {
  const auto found = about(path);
  if (!found || !S_ISREG(found->st_mode)) return;
  const std::lock_guard lock(g_mutex_of_inputs);
  bool& replaceable = g_inputs.try_emplace({found->st_dev, found->st_ino}, true).first->second;
  replaceable = replaceable && in_place;
}

bool spares_inputs(const std::string& path, bool in_place) {
  const auto found = about(path);
  if (!found || is_standard_output(path)) return true;
  const std::lock_guard lock(g_mutex_of_inputs);
  const auto known = g_inputs.find({found->st_dev, found->st_ino});
  if (known == g_inputs.end() || (in_place && known->second)) return true;
  complain("%s: it is an input, and would be overwritten", path.c_str());
  return false;
}

Output::~Output() { discard(); }

bool Output::fail(int error) const {
  complain("%s: %s", path_.c_str(), std::strerror(error));
  return false;
}

bool Output::open(const std::string& path, bool in_place) {
  path_ = path;
  if (path.empty()) return true;
  if (!spares_inputs(path, in_place)) return false;
  const auto found = about(path);
  const bool standard = is_standard_output(path);
  if (!standard && found && S_ISDIR(found->st_mode)) return fail(EISDIR);
  if (!standard && (!found || S_ISREG(found->st_mode))) return open_beside();
  std::FILE* file = standard ? stdout : std::fopen(path.c_str(), "wb");
  if (file == nullptr) return fail(errno);
  const std::lock_guard lock(g_outputs);
  file_ = file;
  next_ = std::exchange(g_first, this);
  return true;
}

bool Output::open_beside() {
  std::error_code error;
  const fs::path target = target_of(path_, error);
  if (error) return fail(error.value());
  if (target.filename().empty()) return fail(EISDIR);
  target_ = target.string();
  is_beside_ = true;
  const auto old = about(target_);
  if (old && ::access(target_.c_str(), W_OK) != 0) return fail(errno);
  constexpr int kMostTries = 1000;  // names that a killed program with this process id has left
  int why = EEXIST;
  for (int i = 0; i < kMostTries && why == EEXIST; ++i) {
    std::string name = beside(target);
    const std::lock_guard lock(g_outputs);
    const int descriptor =
        ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    why = descriptor < 0 ? errno : 0;
    if (descriptor < 0) continue;
    temporary_.swap(name);
    remember_temporary(temporary_);
    next_ = std::exchange(g_first, this);
    if (old) ::fchmod(descriptor, old->st_mode & 07777U);
    file_ = ::fdopen(descriptor, "wb");
    if (file_ == nullptr) why = errno;
  }
  return why == 0 || fail(why);
}

void Output::put(const std::string& text) {
  if (!file_ || failed()) return;
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) error_ = errno;
}

void Output::write(const std::string& text) {
  const std::lock_guard lock(mutex_);
  put(text);
}

void Output::write_last(const std::string& text) {
  const std::lock_guard lock(mutex_);
  put(text);
  ending_ = "";
}

void Output::keep_if_ended(std::string ending) {
  const std::lock_guard lock(mutex_);
  ending_ = std::move(ending);
}

bool Output::close() {
  bool standard = false;
  {
    const std::lock_guard lock(mutex_);
    if (!file_) return true;
    standard = file_ == stdout;
  }
  if (standard) {
    discard();
    return flush_standard_output() && !failed();
  }
  {
    const auto committing = commit_if_beside();
    const std::lock_guard lock(mutex_);
    if (file_) finish();  // unless end_outputs() has done so
  }
  discard();
  if (!failed()) return true;
  complain("%s: could not be written completely: %s", path_.c_str(), std::strerror(error_));
  return false;
}

/// Syncs to disk and renames to the target; sets error_ on failure.
void Output::finish() {
  if (!failed() && std::fflush(file_) != 0) error_ = errno;
  if (!failed() && !temporary_.empty() && ::fsync(::fileno(file_)) != 0) error_ = errno;
  if (std::fclose(std::exchange(file_, nullptr)) != 0 && !failed()) error_ = errno;
  if (!failed() && !temporary_.empty()) {
    if (std::rename(temporary_.c_str(), target_.c_str()) == 0) {
      forget_temporary();
    } else {
      error_ = errno;
    }
  }
}

void Output::discard() {
  const auto committing = commit_if_beside();
  {
    const std::lock_guard lock(g_outputs);
    Output** at = &g_first;
    while (*at != nullptr && *at != this) at = &(*at)->next_;
    if (*at == this) *at = next_;
  }
  if (file_ && file_ != stdout) std::fclose(file_);
  file_ = nullptr;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  forget_temporary();
}

void Output::forget_temporary() {
  for (Temporary& at : g_temporaries) {
    if (at.state == Temporary::kThere && temporary_ == at.name) at.state = Temporary::kFree;
  }
  temporary_.clear();
}

/// Not for a pipe, which may block: it has nothing to commit.
std::unique_lock<std::mutex> Output::commit_if_beside() const {
  return is_beside_ ? commit() : std::unique_lock<std::mutex>();
}

/// Part of end_outputs().
void Output::end(bool keep) {
  constexpr std::chrono::milliseconds kWait{20};  // a write may block on a pipe indefinitely
  std::unique_lock lock(mutex_, std::defer_lock);
  if (!is_beside_) {
    if (!lock.try_lock_for(kWait)) return;
  } else {
    lock.lock();
  }
  if (keep && ending_ && file_ && !failed()) {
    if (std::fputs(ending_->c_str(), file_) < 0) error_ = errno;
    if (file_ != stdout) finish();
  }
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

std::unique_lock<std::mutex> commit() { return std::unique_lock(g_commit); }

void end_outputs(bool keep) {
  // They are not unlocked: the program ends, and other threads must not change files before.
  g_commit.lock();
  g_outputs.lock();
  for (Output* output = g_first; output != nullptr; output = output->next_) output->end(keep);
  if (::ftrylockfile(stdout) != 0) return;
  std::fflush(stdout);
  ::funlockfile(stdout);
}

void remove_temporaries() {
  for (const Temporary& at : g_temporaries) {
    if (at.state == Temporary::kThere) ::unlink(at.name);
  }
}

bool write_file(const std::string& path, const std::string& text, bool in_place) {
  Output file;
  if (!file.open(path, in_place)) return false;
  file.write(text);
  return file.close();
}

void prepare_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor is this one. It is opened for reading, so that writes fail.
    if (::open("/dev/null", O_RDONLY) != stream) return;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool flush_standard_output() {
  static bool reported = false;
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  const std::string why = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  if (!reported) complain("standard output: could not be written completely%s", why.c_str());
  reported = true;
  return false;
}

bool is_standard_output(const std::string& path) {
  if (path.empty()) return false;
  if (path == "-") return true;
  const auto named = about(path);
  const auto standard = about(STDOUT_FILENO);
  // /dev/null is never replaced.
  return named && standard && same(*named, *standard) &&
         (!S_ISCHR(named->st_mode) || ::isatty(STDOUT_FILENO) != 0);
}

void keep_apart(const NamedPaths& outputs, const std::vector<std::string>& inputs) {
  const auto standard_input = about(STDIN_FILENO);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [flag, path] = outputs[i];
    if (path.empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (!same_output(outputs[j].second, path)) continue;
      throw CLI::ValidationError(flag, (path == "-" ? "standard output" : path) +
                                           " is already used by " + outputs[j].first);
    }
    const auto there = about(path == "-" ? "/dev/stdout" : path);
    if (!there || !S_ISREG(there->st_mode)) continue;
    for (const std::string& input : inputs) {
      const auto from = input == "-" ? standard_input : about(input);
      if (!from || !same(*from, *there)) continue;
      throw CLI::ValidationError(flag, path + " is an input: it would be overwritten");
    }
  }
}

bool stderr_is_terminal() { return isatty(fileno(stderr)) != 0; }

}  // namespace substep::cli
