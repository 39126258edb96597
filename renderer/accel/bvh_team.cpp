#include "accel/bvh_team.h"

#include <algorithm>
#include <utility>

namespace crosslight::accel {

Team::Team(std::uint32_t threads) {
  for (std::uint32_t i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
}

Team::~Team() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
}

void Team::work(const std::function<void(std::uint32_t)>& body, std::uint32_t count) {
  try {
    for (std::uint32_t i = next_++; i < count; i = next_++) body(i);
  } catch (...) {
    next_ = count;
    const std::scoped_lock lock(mutex_);
    if (!trouble_) trouble_ = std::current_exception();
  }
}

void Team::help() {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return ends_ || (open_ && round_ != seen); });
    if (ends_) return;
    seen = round_;
    ++busy_;
    const auto& body = *body_;
    const std::uint32_t count = count_;
    lock.unlock();
    work(body, count);
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

void Team::forEach(std::uint32_t count, const std::function<void(std::uint32_t)>& body) {
  if (helpers_.empty() || count < 2) {
    for (std::uint32_t i = 0; i < count; ++i) body(i);
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    body_ = &body;
    count_ = count;
    next_ = 0;
    open_ = true;
    ++round_;
  }
  wake_.notify_all();
  work(body, count);
  std::unique_lock lock(mutex_);
  open_ = false;
  done_.wait(lock, [&] { return busy_ == 0; });
  if (trouble_) std::rethrow_exception(std::exchange(trouble_, nullptr));
}

std::uint32_t usefulThreads(std::uint32_t wanted, std::size_t count) {
  constexpr std::size_t kPrimitivesPerThread = 2048;  // about half a millisecond's work; starting one takes 0.05 ms
  const std::uint32_t threads = wanted != 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
  return static_cast<std::uint32_t>(std::min<std::size_t>(threads, count / kPrimitivesPerThread + 1));
}

}  // namespace crosslight::accel
