// Checks of the program's own invariants, on in every build; both values are printed.
#pragma once

#include <sstream>
#include <string_view>

#include "base/error.h"

namespace crosslight {

[[noreturn]] void checkFailed(std::string_view expression, std::string_view values, std::string_view file, int line);

template <class A, class B>
std::string describePair(const A& a, const B& b) {
  std::ostringstream out;
  out << a << " and " << b;
  return out.str();
}

}  // namespace crosslight

#define CL_CHECK(condition)                                                          \
  do {                                                                               \
    if (!(condition)) ::crosslight::checkFailed(#condition, "", __FILE__, __LINE__); \
  } while (false)
#define CL_CHECK_OP(op, a, b)                                                                                 \
  do {                                                                                                        \
    const auto& clA = (a);                                                                                    \
    const auto& clB = (b);                                                                                    \
    if (!(clA op clB))                                                                                        \
      ::crosslight::checkFailed(#a " " #op " " #b, ::crosslight::describePair(clA, clB), __FILE__, __LINE__); \
  } while (false)
#define CL_CHECK_EQ(a, b) CL_CHECK_OP(==, a, b)
#define CL_CHECK_LT(a, b) CL_CHECK_OP(<, a, b)
#define CL_CHECK_LE(a, b) CL_CHECK_OP(<=, a, b)
