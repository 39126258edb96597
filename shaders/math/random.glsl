// Randomness as a function of a place, a sample's number and a seed: never of time or of the order of threads.
#ifndef CROSSLIGHT_RANDOM_GLSL
#define CROSSLIGHT_RANDOM_GLSL

// O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms": the output of one step.
uint hashOf(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}
uint hashOf(uint a, uint b) { return hashOf(a ^ hashOf(b)); }
uint hashOf(uvec3 v) { return hashOf(hashOf(v.x, v.y), v.z); }

// Burley 2020, "Practical Hash-based Owen Scrambling", Listing 3, after Laine, Karras 2011: each bit is flipped by those
// above it. Takes and gives reversed bits.
uint scrambleReversed(uint bits, uint seed) {
  bits ^= bits * 0x3d20adeau;
  bits += seed;
  bits *= (seed >> 16u) | 1u;
  bits ^= bits * 0x05526c56u;
  bits ^= bits * 0x53a22864u;
  return bits;
}
uint owenScramble(uint bits, uint seed) { return bitfieldReverse(scrambleReversed(bitfieldReverse(bits), seed)); }

// Sobol 1967: the second dimension; the first is the number's bits reversed.
uint sobolSecond(uint index) {
  uint bits = 0u;
  uint direction = 0x80000000u;
  for (uint rest = index; rest != 0u; rest >>= 1u) {
    if ((rest & 1u) != 0u) bits ^= direction;
    direction ^= direction >> 1u;
  }
  return bits;
}

// Sample `index` of a (0,2)-sequence of its own for each scramble, in [0,1)^2; the order is scrambled as well.
vec2 owenSobol(uint index, uint scramble) {
  uint shuffled = bitfieldReverse(scrambleReversed(bitfieldReverse(index), scramble));
  uint x = scrambleReversed(shuffled, hashOf(scramble, 1u));  // reversed twice
  uint y = owenScramble(sobolSecond(shuffled), hashOf(scramble, 2u));
  return vec2(bitfieldReverse(x) >> 8u, y >> 8u) * (1.0 / 16777216.0);
}
#endif
