// voxelise.frag     T_IO = (velocity of the obstacle, type of the cell)    Yang et al. 2009, section IV-A
//
// reads   the bodies' shapes, poses and motions (uniforms)             [cells], [m/s]
// writes  T_IO        RGBA32F  Cells (nx, ny, nz)                      rgb [m/s], 0 in fluid; alpha: cell_types.glsl
// fetches 0
//
// A cell is obstacle when its centre is inside a body. What lies beyond the tank's walls is nobody's neighbour.
#include "cell_types.glsl"

out vec4 io;

bool solid_at(ivec3 c) {
    return solid_distance(vec3(c) + 0.5) < 0.0;
}

void main() {
    ivec3 c = cell_here(TARGET), last = TARGET.size - 1;
    bool solid = solid_at(c), touches = false;
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 e = ivec3(equal(ivec3(axis), ivec3(0, 1, 2)));
        if (solid_at(max(c - e, 0)) != solid || solid_at(min(c + e, last)) != solid) touches = true;
    }
    if (solid) io = vec4(solid_velocity(vec3(c) + 0.5), touches ? kBoundary : kInside);
    else io = vec4(0.0, 0.0, 0.0, touches ? kSurrounding : kOutside);
}
