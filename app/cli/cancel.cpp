#include "app/cli/cancel.hpp"

#include <csignal>

namespace substep::cli {
namespace {

std::atomic<bool> g_cancelled{false};

extern "C" void note_cancel(int signal) {
  g_cancelled = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& cancel_on_signal() {
  std::signal(SIGINT, note_cancel);
  std::signal(SIGTERM, note_cancel);
  return g_cancelled;
}

}  // namespace substep::cli
