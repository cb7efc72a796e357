// A library for LD_PRELOAD: a slow disk. fsync() takes SUBSTEP_FSYNC_MS milliseconds longer.

#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

extern "C" int fsync(int descriptor) {
  const char* text = std::getenv("SUBSTEP_FSYNC_MS");
  const auto until = std::chrono::steady_clock::now() +
                     std::chrono::milliseconds(text != nullptr ? std::atoi(text) : 0);
  while (std::chrono::steady_clock::now() < until) {  // a signal does not shorten it
    std::this_thread::sleep_until(until);
  }
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}
