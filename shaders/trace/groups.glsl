// In which order the groups of a dispatch take their share of a list of rays. llvmpipe gives each of its threads one run
// of consecutive groups: in the list's own order one thread would have the top of the picture and another the bottom.
#ifndef CROSSLIGHT_GROUPS_GLSL
#define CROSSLIGHT_GROUPS_GLSL
#extension GL_EXT_control_flow_attributes : require

// The group's place in the list. Neighbors stay together by fours, for the caches; the fours are dealt like cards, three
// times over, so that up to eight threads go over the whole list side by side. What does not fill both halves stays.
uint spreadGroup() {
  uint four = gl_WorkGroupID.x / 4u;
  uint pairs = gl_NumWorkGroups.x / 8u;  // of fours
  [[unroll]] for (int deal = 0; deal < 3; ++deal)
    four = four >= 2u * pairs ? four : (four < pairs ? 2u * four : 2u * (four - pairs) + 1u);
  return 4u * four + gl_WorkGroupID.x % 4u;
}
#endif
