// Further bits of TextureSlot::flags: how a minified texture is read.
#ifndef CROSSLIGHT_SHARED_TEXTURE_FLAGS_H
#define CROSSLIGHT_SHARED_TEXTURE_FLAGS_H
#include "types.h"

CL_SHARED_BEGIN
CL_CONST uint kTextureMips = 64u;         // level 1 and so on follow, each half as wide and high, down to one texel
CL_CONST uint kTextureMipLinear = 128u;   // between two levels; else the nearest one
CL_CONST uint kTextureMinNearest = 256u;  // within a level, where minified
CL_SHARED_END
#endif
