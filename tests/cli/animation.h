// A scene that moves, written by the test itself.
#pragma once

#include <string>

namespace crosslight::test {

// A triangle that flies along x in four seconds (animation "fly"), and turns over in one (animation "roll").
std::string movingTriangle();

}  // namespace crosslight::test
