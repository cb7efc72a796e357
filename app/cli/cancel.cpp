#include "app/cli/cancel.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <thread>

#include "app/cli/commands.hpp"
#include "app/cli/output.hpp"

namespace substep::cli {
namespace {

// Long enough for a command that checks the flag after every frame, short enough for the user.
constexpr std::chrono::milliseconds kPatience{120};

std::atomic<bool> g_cancelled{false};
sem_t g_signalled;

extern "C" void note_cancel(int signal) {
  g_cancelled = true;
  sem_post(&g_signalled);
  std::signal(signal, SIG_DFL);
}

/// Ends the program if the command has not done so: a single frame may take minutes.
void end_when_signalled() {
  while (sem_wait(&g_signalled) != 0) {
  }
  std::this_thread::sleep_for(kPatience);
  end_outputs(true);
  constexpr std::string_view kText = "cancelled\n";
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kText.data(), kText.size());
  std::_Exit(kCancelled);
}

bool watch() {
  sem_init(&g_signalled, 0, 0);
  try {
    std::thread(end_when_signalled).detach();
  } catch (const std::system_error&) {
    // No thread available: commands that check the flag still end.
  }
  std::signal(SIGINT, note_cancel);
  std::signal(SIGTERM, note_cancel);
  return true;
}

}  // namespace

const std::atomic<bool>& cancel_on_signal() {
  [[maybe_unused]] static const bool watching = watch();
  return g_cancelled;
}

}  // namespace substep::cli
