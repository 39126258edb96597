#include "study/catalog.h"

#include "study/cases.h"

namespace crosslight::study {

const std::vector<HardCase>& hardCases() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases;
    for (const auto& list : {depthCases(), surfaceCases(), textureCases(), pipelineCases(), transformCases(),
                             shadowCases(), lightCases(), modelCases(), energyCases(), opticsCases(), glassCases(),
                             shapeCases(), torusCases(), meshCases(), treeCases(), mathCases(), angleCases()})
      cases.insert(cases.end(), list.begin(), list.end());
    return cases;
  }();
  return all;
}

const std::vector<Uncovered>& uncoveredCases() {
  static const char* const kNoPaths = "there is no path tracer";
  static const char* const kNoPhotons = "there are no photon maps";
  static const std::vector<Uncovered> all{
      {"R3", "depth of one long floor", nullptr},
      {"R6", "T-junctions", "no check of meshes looks for vertices on others' edges"},
      {"R15", "seams of cube maps", nullptr},
      {"R19", "what is not a number does not spread", "no pass reads neighboring pixels"},
      {"T9", "parity of crossings", nullptr},
      {"T26", "the terminator of smooth meshes", nullptr},
      {"G1", "furnace", kNoPaths},
      {"G2", "Cornell box", kNoPaths},
      {"G3", "weights of several estimators", kNoPaths},
      {"G4", "nearly specular lobes", kNoPaths},
      {"G5", "fireflies", kNoPaths},
      {"G9", "atomic sums", "nothing is summed by several threads at once"},
      {"G10", "photons at edges", kNoPhotons},
      {"G11", "paths without throughput", kNoPaths},
  };
  return all;
}

}  // namespace crosslight::study
