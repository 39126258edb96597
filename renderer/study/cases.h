// The cases, by what they need; private to the room. Each list is one file of the same name.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "study/hard_case.h"

namespace crosslight::study {

// Oracles compute in this, on the rounded single-precision arguments taken as exact.
using Real = long double;
using Vec = glm::vec<3, Real, glm::highp>;
inline constexpr Real kPiReal = 3.14159265358979323846264338327950288L;

inline constexpr double kU = 0x1p-24;    // unit roundoff of single precision
inline constexpr double kUlp = 0x1p-23;  // of 1
// n roundings (Higham 2002, "Accuracy and Stability of Numerical Algorithms", Lemma 3.1).
constexpr double gammaOf(int n) { return n * kU / (1 - n * kU); }

std::vector<HardCase> mathCases();
std::vector<HardCase> angleCases();
std::vector<HardCase> opticsCases();
std::vector<HardCase> modelCases();
std::vector<HardCase> energyCases();
std::vector<HardCase> textureCases();
std::vector<HardCase> pipelineCases();
std::vector<HardCase> shapeCases();
std::vector<HardCase> torusCases();
std::vector<HardCase> meshCases();
std::vector<HardCase> treeCases();
std::vector<HardCase> depthCases();
std::vector<HardCase> transformCases();
std::vector<HardCase> shadowCases();
std::vector<HardCase> lightCases();
std::vector<HardCase> glassCases();
std::vector<HardCase> surfaceCases();

}  // namespace crosslight::study
