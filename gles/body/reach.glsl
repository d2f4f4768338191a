// reach.glsl     How far from a face a surface is that just touches its cell, as fraction.glsl smears it out
const float kReach = 0.83;  // [cells]: 0.8 to 0.87, by the surface's direction
