// A limit on how long one run may take.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

namespace diptych::runner {

/// From its start on a thread watches the clock, and what stops all runs: solvers ask nothing but a flag.
class Deadline {
 public:
  Deadline(double seconds, const std::atomic<bool>* cancelled)
      : watch_([this, seconds, cancelled](const std::stop_token& over) { watch(seconds, cancelled, over); }) {}

  /// True once the run should stop: of time, or because all should.
  const std::atomic<bool>* stop() const { return &stop_; }
  bool passed() const { return passed_; }

 private:
  void watch(double seconds, const std::atomic<bool>* cancelled, const std::stop_token& over) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    constexpr std::chrono::milliseconds glance{20};
    std::mutex mutex;
    std::condition_variable_any bell;
    std::unique_lock lock(mutex);
    while (!over.stop_requested() && !stop_) {
      if (Clock::now() >= end) passed_ = true;
      if (passed_ || (cancelled && *cancelled)) stop_ = true;
      bell.wait_until(lock, over, std::min(end, Clock::now() + glance), [] { return false; });
    }
  }

  std::atomic<bool> stop_{false}, passed_{false};
  std::jthread watch_;  // last: it is joined before what it writes to goes
};

}  // namespace diptych::runner
