// Pass display: linear radiance to sRGB codes. Needs optics-inl.h.

template <class N>
RAINREF_FN Vec3<N> display(const DisplayUniforms& u, const Vec3<N>& colour) { return display_code(N(u.exposure) * colour); }
