// Threads of one build that share loops. What a loop computes must not depend on which thread takes which turn.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace crosslight::accel {

class Team {
 public:
  explicit Team(std::uint32_t threads);  // the caller is one of them
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  std::uint32_t size() const { return static_cast<std::uint32_t>(helpers_.size()) + 1; }
  // body(i) for every i below `count`, begun in rising order; returns when all are done, and throws what one threw.
  void forEach(std::uint32_t count, const std::function<void(std::uint32_t)>& body);

 private:
  void help();
  void work(const std::function<void(std::uint32_t)>& body, std::uint32_t count);

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void(std::uint32_t)>* body_ = nullptr;
  std::uint32_t count_ = 0;
  std::uint64_t round_ = 0;
  std::uint32_t busy_ = 0;  // helpers within this round
  bool open_ = false;       // helpers may still join: one that wakes late is not waited for
  bool ends_ = false;
  std::exception_ptr trouble_;
  std::atomic<std::uint32_t> next_{0};
  std::vector<std::jthread> helpers_;
};

// Threads worth starting for `count` primitives, `wanted` of them asked for (0: the machine's).
std::uint32_t usefulThreads(std::uint32_t wanted, std::size_t count);

}  // namespace crosslight::accel
