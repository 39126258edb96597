// What the writer and the reader of part files must agree on. Private to them; part.h describes the format.
#pragma once

#include <bit>

namespace crosslight {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");

inline constexpr char kPartMagic[] = {'C', 'L', 'P', 'A', 'R', 'T', '1', '\n'};
inline constexpr int kPartSchema = 1;

}  // namespace crosslight
