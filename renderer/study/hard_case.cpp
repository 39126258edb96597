#include "study/hard_case.h"

namespace crosslight::study {

void CaseResult::measure(std::string technique, std::string what, const Worst& worst, double bound, std::string unit) {
  measurements_.push_back({std::move(technique), std::move(what), std::move(unit), worst.got(), worst.expected(),
                           std::max(worst.error(), 0.0), bound, worst.naive(), worst.compared()});
  if (std::isnan(worst.error())) measurements_.back().error = worst.error();
}

void CaseResult::count(std::string technique, std::string what, std::uint64_t wrong, std::uint64_t compared,
                       std::optional<double> naive) {
  const auto number = static_cast<double>(wrong);
  measurements_.push_back({std::move(technique), std::move(what), "count", number, 0.0, number, 0.0, naive, compared});
}

}  // namespace crosslight::study
