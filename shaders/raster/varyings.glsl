// The interface between the raster stages. CL_STAGE is `in` or `out`; CL_SUMS_MODE is the interpolation of lighting
// computed per vertex (`smooth` for Gouraud, `flat` for flat shading) and undefined where lighting is per fragment.
layout(location = 0) CL_STAGE vec3 renderPos;
layout(location = 1) CL_STAGE vec3 renderNormal;
layout(location = 2) CL_STAGE vec4 renderTangent;
layout(location = 3) CL_STAGE vec4 uvs;  // uv0, uv1
layout(location = 4) CL_STAGE vec4 vertexColor;
layout(location = 5) flat CL_STAGE uint drawId;
#ifdef CL_SUMS_MODE
layout(location = 6) CL_SUMS_MODE CL_STAGE vec3 frontAmbient;
layout(location = 7) CL_SUMS_MODE CL_STAGE vec3 frontDiffuse;
layout(location = 8) CL_SUMS_MODE CL_STAGE vec3 frontSpecular;
layout(location = 9) CL_SUMS_MODE CL_STAGE vec3 frontFresnel;
layout(location = 10) CL_SUMS_MODE CL_STAGE vec3 backAmbient;
layout(location = 11) CL_SUMS_MODE CL_STAGE vec3 backDiffuse;
layout(location = 12) CL_SUMS_MODE CL_STAGE vec3 backSpecular;
layout(location = 13) CL_SUMS_MODE CL_STAGE vec3 backFresnel;
#endif
