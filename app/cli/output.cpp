#include "app/cli/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace substep::cli {

Output::~Output() {
  if (file_ && file_ != stdout) std::fclose(file_);
}

bool Output::open(const std::string& path) {
  path_ = path;
  if (path.empty()) return true;
  file_ = path == "-" ? stdout : std::fopen(path.c_str(), "wb");
  if (!file_) std::fprintf(stderr, "%s: %s\n", path.c_str(), std::strerror(errno));
  return file_ != nullptr;
}

void Output::write(const std::string& text) {
  if (file_) std::fwrite(text.data(), 1, text.size(), file_);
}

bool Output::close() {
  if (!file_) return true;
  const bool written = std::fflush(file_) == 0 && std::ferror(file_) == 0;
  const bool closed = file_ == stdout || std::fclose(file_) == 0;
  file_ = nullptr;
  if (written && closed) return true;
  std::fprintf(stderr, "%s: could not be written to its end\n", path_.c_str());
  return false;
}

bool same_output(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  if (a == "-" || b == "-") return a == b;
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_character_file(a, error))
    return false;  // a device such as /dev/null may be named twice
  if (a == b || fs::equivalent(a, b, error)) return true;
  const fs::path path_a = fs::weakly_canonical(a, error);
  const fs::path path_b = fs::weakly_canonical(b, error);
  return !error && path_a == path_b;
}

bool stderr_is_terminal() { return isatty(fileno(stderr)) != 0; }

}  // namespace substep::cli
