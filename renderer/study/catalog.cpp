#include "study/catalog.h"

#include "study/cases.h"

namespace crosslight::study {

const std::vector<HardCase>& hardCases() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases;
    for (const auto& list :
         {depthCases(), surfaceCases(), transformCases(), shadowCases(), lightCases(), modelCases(), energyCases(),
          opticsCases(), glassCases(), shapeCases(), torusCases(), meshCases(), treeCases(), mathCases()})
      cases.insert(cases.end(), list.begin(), list.end());
    return cases;
  }();
  return all;
}

const std::vector<Uncovered>& uncoveredCases() {
  static const char* const kNoPaths = "there is no path tracer";
  static const char* const kNoPhotons = "there are no photon maps";
  static const std::vector<Uncovered> all{
      {"R1", "depth resolution by distance", nullptr},
      {"R3", "depth of one long floor", nullptr},
      {"R4", "the same depth in several passes", nullptr},
      {"R6", "T-junctions", "no check of meshes looks for vertices on others' edges"},
      {"R11", "attributes with a large offset", nullptr},
      {"R14", "shadows detached by the maps' offset", nullptr},
      {"R15", "seams of cube maps", nullptr},
      {"R19", "what is not a number does not spread", "no pass reads neighboring pixels"},
      {"R20", "checkers far from their origin", nullptr},
      {"I6", "reduced precision in shaders", nullptr},
      {"I18", "frames about a normal near -z", nullptr},
      {"I19", "small angles", nullptr},
      {"T9", "parity of crossings", nullptr},
      {"T22", "a thousand reflections", nullptr},
      {"T26", "the terminator of smooth meshes", nullptr},
      {"X2", "mirrored texture coordinates", nullptr},
      {"X4", "poles and seams of spheres", nullptr},
      {"G1", "furnace", kNoPaths},
      {"G2", "Cornell box", kNoPaths},
      {"G3", "weights of several estimators", kNoPaths},
      {"G4", "nearly specular lobes", kNoPaths},
      {"G5", "fireflies", kNoPaths},
      {"G8", "sums of millions of samples", nullptr},
      {"G9", "atomic sums", "nothing is summed by several threads at once"},
      {"G10", "photons at edges", kNoPhotons},
      {"G11", "paths without throughput", kNoPaths},
      {"G12", "small solid angles", nullptr},
  };
  return all;
}

}  // namespace crosslight::study
