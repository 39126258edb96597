// Lambert 1760, "Photometria": kd (N.L), nothing for light from behind.
Lobe evaluateLambert(SurfacePoint s, vec3 wo, vec3 wi) { return lobeOf(max(dot(s.n, wi), 0.0), 0.0); }
