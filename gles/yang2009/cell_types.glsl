// cell_types.glsl     What the alpha channel of the inside-outside texture T_IO means.   Yang et al. 2009, section IV-A
//
// The same numbers as enum CellType in voxels.h. Larger than kSurrounding: obstacle.
const float kOutside = 0.0;      // fluid that touches no body
const float kSurrounding = 1.0;  // fluid that shares a face with a boundary cell
const float kBoundary = 2.0;     // obstacle that shares a face with fluid
const float kInside = 3.0;       // obstacle all around

bool is_obstacle(vec4 io) {
    return io.w > 1.5;
}
