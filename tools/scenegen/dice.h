// Random choices from a seed alone: the same on every machine and with every standard library. Arguments of calls have
// no order in C++: whoever asks twice for one value does it in two statements or within braces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>

namespace crosslight::scenegen {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  // Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom Number Generators", Fig. 17 (SplitMix64).
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  // 0 to n - 1; how much one is likelier than another is n in 2^32.
  int below(int n) { return static_cast<int>(((next() >> 32) * static_cast<std::uint64_t>(n)) >> 32); }
  bool oneIn(int n) { return below(n) == 0; }

  // One of 1025 values, both ends among them, of few digits where the ends have few.
  double between(double low, double high) { return low + (high - low) * (below(1025) / 1024.0); }

  // An end of the range, where formulas have their special cases, in two of five; else between.
  double orEnd(double low, double high) {
    const int which = below(5);
    return which == 0 ? low : which == 1 ? high : between(low, high);
  }

  glm::dvec3 vector(double low, double high) {
    return glm::dvec3{between(low, high), between(low, high), between(low, high)};
  }

  template <class T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[static_cast<std::size_t>(below(static_cast<int>(list.size())))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace crosslight::scenegen
