// guard.glsl     A value of a field that lives from step to step, where it is first read: 0 if it cannot be one
//
// One bad texel (a fault in memory, a driver's) would else spread by a cell with each sweep and stay for ever. Looked for in
// the bits, since compilers may take for granted that nothing is NaN or infinite: without their sign, those and all that is
// larger than `most` are, as integers, larger than its bits.
const uint kAllButSign = 0x7fffffffu;

// Smoke is a density around 1 and heat some hundred kelvins: no scene comes near this in years of steps.
const float kMostScalar = 1e12;

uvec4 bits_of(vec4 v) {
    return floatBitsToUint(v) & kAllButSign;
}

bvec4 unsound(vec4 v, float most) {
    return greaterThan(bits_of(v), uvec4(floatBitsToUint(most)));
}

vec4 sound(vec4 v, float most) {
    return mix(v, vec4(0.0), unsound(v, most));
}
// A pressure to start a step from. In a pocket that a body has sealed (a piston in a tube), or a closed tank with an inflow, none
// is ever enough and each step adds the same again. Beyond a limit far from any flow's, a fifth of the excess is dropped in each
// step: it ends at five times what one adds. Half of it at once would bend the pressure inside the pocket, and stir it.
vec4 kept(vec4 phi, float most) {
    float limit = 0.0625 * most;
    vec4 p = sound(phi, most);
    return p - 0.2 * (p - clamp(p, -limit, limit));  // guard pocket
}
vec3 sound(vec3 v, float most) {
    return sound(vec4(v, 0.0), most).xyz;
}
float sound(float v, float most) {
    return sound(vec4(v, 0.0, 0.0, 0.0), most).x;
}
