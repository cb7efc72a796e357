#include "app/cli/cancel.hpp"

#include <poll.h>
#include <semaphore.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <thread>

#include "app/cli/message.hpp"
#include "app/cli/output.hpp"

namespace substep::cli {
namespace {

// Long enough for a command that checks the flag after every frame, short enough for the user.
constexpr std::chrono::milliseconds kPatience{120};
constexpr std::chrono::milliseconds kSlice{10};
// Standard error may be a blocked pipe. Long enough for the command to print its message.
constexpr std::chrono::seconds kBlocked{1};

std::atomic<bool> g_cancelled{false};
std::atomic<int> g_signal{0};  // the first
std::atomic<int> g_signals{0};
std::timed_mutex g_saying;  // held while the message is printed
std::atomic<bool> g_said{false};
sem_t g_signalled;

extern "C" void note_cancel(int signal) {
  constexpr int kMostSignals = 3;
  int none = 0;
  g_signal.compare_exchange_strong(none, signal);
  g_cancelled = true;
  if (++g_signals == kMostSignals) ::alarm(1);
  sem_post(&g_signalled);
}

void write_cancelled() {
  static constexpr char kText[] = "cancelled\n";
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kText, sizeof kText - 1);
}

extern "C" void end_at_once(int /*signal*/) {
  remove_temporaries();
  pollfd error{STDERR_FILENO, POLLOUT, 0};
  if (!g_said && ::poll(&error, 1, 0) == 1) write_cancelled();
  ::_exit(cancelled_code());
}

/// Ends the program if the command has not done so: a single frame may take minutes.
void end_when_signalled() {
  while (sem_wait(&g_signalled) != 0) {
  }
  for (auto waited = kSlice; waited <= kPatience && sem_trywait(&g_signalled) != 0;
       waited += kSlice) {
    std::this_thread::sleep_for(kSlice);
  }
  end_outputs(true);
  const std::unique_lock lock(g_saying, kBlocked);
  if (lock.owns_lock() && !g_said.exchange(true)) write_cancelled();
  std::_Exit(cancelled_code());
}

/// A program that is started with nohup, or in the background by a script, keeps ignoring them.
void handle(int signal) {
  struct sigaction action {};
  if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = note_cancel;
  action.sa_flags = SA_RESTART;
  ::sigaction(signal, &action, nullptr);
}

bool watch() {
  sem_init(&g_signalled, 0, 0);
  try {
    std::thread(end_when_signalled).detach();
  } catch (const std::system_error&) {
    // No thread available: commands that check the flag still end.
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal);
  struct sigaction action {};
  action.sa_handler = end_at_once;
  ::sigaction(SIGALRM, &action, nullptr);
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  ::pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
  return true;
}

}  // namespace

const std::atomic<bool>& cancel_on_signal() {
  [[maybe_unused]] static const bool watching = watch();
  return g_cancelled;
}

int cancelled_code() {
  constexpr int kSignalled = 128;
  return kSignalled + (g_signal != 0 ? g_signal.load() : SIGINT);
}

void say_cancelled(const std::string& what) {
  const std::lock_guard lock(g_saying);
  if (!g_said.exchange(true)) complain("cancelled%s", what.c_str());
}

}  // namespace substep::cli
