#include "base/check.h"

namespace crosslight {

void checkFailed(std::string_view expression, std::string_view values, std::string_view file, int line) {
  std::ostringstream out;
  out << "broken invariant: " << expression;
  if (!values.empty()) out << " (values " << values << ")";
  out << " at " << file << ":" << line;
  throw InternalError(out.str());
}

}  // namespace crosslight
