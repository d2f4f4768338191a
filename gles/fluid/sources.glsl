// sources.glsl     What flows from the sources into the cell around x [cells] during this step; 0 without SOURCES.
//
// Variant SOURCES (their number) is drawn only where they are.
#ifdef SOURCES
uniform vec4 source_ball[SOURCES];   // centre, radius  [cells]
uniform vec3 source_gain[SOURCES];   // x: dt q

float from_sources(vec3 x) {
    float gain = 0.0;
    for (int i = 0; i < SOURCES; ++i)
        gain += source_gain[i].x * clamp(source_ball[i].w - distance(x, source_ball[i].xyz) + 0.5, 0.0, 1.0);
    return gain;
}
#else
float from_sources(vec3 x) {
    return 0.0;
}
#endif
