// grip.frag     w = how firmly a body's surface holds the fluid at each face;  surface = the body's velocity there
//
// reads   distances   RGBA32F  Faces (nx+1, ny+1, nz+1)   [cells]
// reads   shares      RGBA32F  Faces                      fluid's share of the cell around each face
// reads   the bodies' poses and motions (uniforms)                     not by variant COARSE
// writes  w           RGBA32F  Faces                      friction is nu w (u_surface - u) / h^2
// writes  surface     RGBA32F  Faces                      [m/s]        not by variant COARSE
// fetches 14
//
// The velocity kept at a face that a surface cuts is that of the middle of its fluid, at a distance delta from the surface:
// less than the face's own distance d if some of the cell is solid, and never nothing as long as there is fluid. Links
// between neighbours have the mean of their shares. w is what makes a uniform shear u = delta an exact solution,
//     w delta = sum_links (delta_nb - delta)  -  v laplacian(d),
// where the last term takes back what a curved surface alone adds. In the middle of a thin solid d has a kink, which is no
// curvature: there |grad d| falls below 1, and the term goes with it. All of it moves smoothly as the body does.
uniform sampler2D distances, shares;

layout(location = 0) out vec4 w;
#ifndef COARSE
layout(location = 1) out vec4 surface;
#endif

#include "beyond_walls.glsl"
#include "reach.glsl"
const float kLeastMiddle = 0.02;

vec3 middle(vec3 d) {
    vec3 s = max(d + kReach, 0.0);
    return mix(s * s / (4.0 * kReach), d, vec3(greaterThan(d, vec3(kReach))));
}

void main() {
    ivec3 c = cell_here(FACES);
    vec3 d = at(distances, FACES, c).xyz, v = at(shares, FACES, c).xyz, delta = middle(d);
    vec3 stretch = vec3(0.0), curvature = vec3(0.0), normal[3];
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 e = ivec3(equal(ivec3(axis), ivec3(0, 1, 2)));
        vec3 low = at_clamped(distances, FACES, c - e).xyz, high = at_clamped(distances, FACES, c + e).xyz;
        go_on_beyond_walls(c, axis, d, low, high);
        vec3 v_low = at_clamped(shares, FACES, c - e).xyz;
        vec3 v_high = mix(at_clamped(shares, FACES, c + e).xyz, v, last_before_wall(c, axis));
        stretch += 0.5 * (v + v_low) * vec3(greaterThan(v_low, vec3(0.0))) * (middle(low) - delta);
        stretch += 0.5 * (v + v_high) * vec3(greaterThan(v_high, vec3(0.0))) * (middle(high) - delta);
        // In the same order: away from all surfaces what is left is 0 to the last digit.
        curvature += low - d;
        curvature += high - d;
        normal[axis] = 0.5 * (high - low);
    }
    for (int k = 0; k < 3; ++k) {
        float slope = length(vec3(normal[0][k], normal[1][k], normal[2][k]));
        curvature[k] *= max(smoothstep(0.3, 0.8, slope), smoothstep(0.0, kReach, d[k]));
    }
    w = vec4(max(stretch - v * curvature, 0.0) / max(delta, kLeastMiddle), 0.0);
    w.xyz *= vec3(greaterThan(v, vec3(0.0)));
#ifndef COARSE
    for (int k = 0; k < 3; ++k) {
        vec3 x = vec3(c) + 0.5 - 0.5 * vec3(equal(ivec3(k), ivec3(0, 1, 2)));
        vec3 n = vec3(normal[0][k], normal[1][k], normal[2][k]);
        surface[k] = solid_velocity(x - d[k] * n / max(length(n), 0.1))[k];
    }
    surface.w = 0.0;
#endif
}
