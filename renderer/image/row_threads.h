// Rows of a picture shared out to the machine's cores, for work whose result does not depend on who does it.
#pragma once

#include <cstdint>
#include <functional>

namespace crosslight {

// Calls `work` for disjoint ranges [first, end) that cover 0 .. rows, in threads where `valuesPerRow` make that pay. An
// exception of any of them is thrown on.
void forRowRanges(std::uint32_t rows, std::uint64_t valuesPerRow,
                  const std::function<void(std::uint32_t first, std::uint32_t end)>& work);

}  // namespace crosslight
