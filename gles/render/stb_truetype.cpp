// The code of the library that gles/render/font.cpp calls; Debian's headers hold it all.
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
