// A loop over independent items on a few threads, for the peers.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace crosslight::bench {

// Calls body(first, end) for pieces of [0, count) until all are done. Pieces are taken as threads get free.
template <class Body>
void parallelFor(std::size_t count, std::size_t piece, unsigned threads, const Body& body) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t first = next.fetch_add(piece); first < count; first = next.fetch_add(piece)) {
      body(first, std::min(first + piece, count));
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
}

}  // namespace crosslight::bench
