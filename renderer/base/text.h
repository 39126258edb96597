// Text that came from somewhere else, made fit to be shown.
#pragma once

#include <string>
#include <string_view>

namespace crosslight {

// Control characters but the line feed become '?': names from files must not steer a terminal.
std::string printable(std::string_view text);

}  // namespace crosslight
