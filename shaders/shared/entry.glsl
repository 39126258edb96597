// Included first by every entry point. SignedZeroInfNanPreserve keeps compilers from rearranging floating-point
// arithmetic by the laws of real numbers: a specialised pipeline then computes the same bits as the full one.
#ifndef CROSSLIGHT_ENTRY_GLSL
#define CROSSLIGHT_ENTRY_GLSL
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_spirv_intrinsics : require
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4466], 4461, 32);
#endif
