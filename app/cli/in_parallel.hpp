#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <future>
#include <system_error>
#include <vector>

namespace substep::cli {

/// Calls work(0) to work(count - 1) on several threads; fewer if the system has no more.
/// @param work returns false, or throws, to begin no further call
/// @param meanwhile called every 50 ms from this thread; if empty, this thread works too
inline void in_parallel(std::size_t count, int jobs, const std::function<bool(std::size_t)>& work,
                        const std::function<void()>& meanwhile = {}) {
  std::atomic<std::size_t> next{0};
  const auto worker = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        if (!work(i)) next = count;
      }
    } catch (...) {
      next = count;
      throw;
    }
  };
  const std::size_t wanted = std::min(static_cast<std::size_t>(jobs), count);
  std::vector<std::future<void>> threads;
  try {
    while (threads.size() + (meanwhile ? 0 : 1) < wanted) {
      threads.push_back(std::async(std::launch::async, worker));
    }
  } catch (const std::system_error&) {
    // Continue with fewer.
  }
  if (!meanwhile || threads.empty()) worker();
  for (std::future<void>& thread : threads) {
    while (meanwhile &&
           thread.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout) {
      meanwhile();
    }
    thread.get();  // rethrows
  }
}

}  // namespace substep::cli
