#include "tests/app/child.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace substep {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string head_of(const fs::path& path) {
  constexpr std::size_t kMost = std::size_t{64} << 20U;
  std::ifstream file(path, std::ios::binary);
  std::string text(std::min<std::size_t>(kMost, fs::file_size(path)), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

/// In the child: redirects a stream to a file, or closes it if the path is empty.
void place(int stream, const std::string& path, int flags) {
  ::close(stream);
  if (path.empty()) return;
  const int file = ::open(path.c_str(), flags, 0666);
  if (file < 0) std::_Exit(126);
  if (file == stream) return;
  ::dup2(file, stream);
  ::close(file);
}

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// In the child, which has one thread: replaces it with the program.
[[noreturn]] void become(const std::string& program, const HostileInput& input,
                         const fs::path& folder, const std::string& out, const std::string& err) {
  if (::chdir(folder.c_str()) != 0) std::_Exit(126);
  std::signal(SIGINT, SIG_DFL);  // the tests may run in the background
  place(STDIN_FILENO, input.standard_input, O_RDONLY);
  place(STDOUT_FILENO,
        input.output_is_closed ? ""
        : input.output_is_full ? "/dev/full"
                               : out,
        O_WRONLY | O_CREAT | O_TRUNC);
  place(STDERR_FILENO, err, O_WRONLY | O_CREAT | O_TRUNC);
  if (input.most_file > 0) limit(RLIMIT_FSIZE, input.most_file);
  limit(RLIMIT_CORE, 0);
#if !defined(__SANITIZE_ADDRESS__)  // AddressSanitizer maps all of the address space
  limit(RLIMIT_AS, rlim_t{4} << 30U);
#endif
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : input.arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  ::execv(program.c_str(), words.data());
  std::_Exit(126);
}

}  // namespace

Ending run_child(const std::string& program, const HostileInput& input, const fs::path& folder,
                 double patience) {
  // Beside the folder: the folder itself holds only the program's files.
  const std::string out = folder.string() + ".out";
  const std::string err = folder.string() + ".err";
  std::ofstream(out, std::ios::trunc);
  std::ofstream(err, std::ios::trunc);
  const pid_t child = ::fork();
  if (child == 0) become(program, input, folder, out, err);

  Ending ending;
  Clock::time_point begin = Clock::now();
  const double interruption =
      input.interrupted_after > 0 ? 1e-3 * input.interrupted_after : patience;
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, WNOHANG, &usage) == 0) {
    if (!ending.interrupted && since(begin) >= interruption) {
      ending.interrupted = true;
      begin = Clock::now();
      ::kill(child, SIGINT);
    } else if (ending.interrupted && !ending.hung && since(begin) >= patience) {
      ending.hung = true;
      ::kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ending.seconds = since(begin);
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  ending.memory = static_cast<std::size_t>(usage.ru_maxrss) << 10U;
  ending.out = head_of(out);
  ending.err = head_of(err);
  return ending;
}

}  // namespace substep
