# The libraries Eddy stands on. Everything but the driver stack is linked statically (see tests/end_to_end/needed_test.cpp).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

find_package(glm REQUIRED)
add_library(glm_headers INTERFACE)
target_link_libraries(glm_headers INTERFACE glm::glm)
target_compile_definitions(glm_headers INTERFACE GLM_FORCE_XYZW_ONLY GLM_FORCE_EXPLICIT_CTOR)

# What a driver vendor or the kernel's device manager imposes stays dynamic.
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(GLESV2 REQUIRED IMPORTED_TARGET glesv2)
pkg_check_modules(LIBDRM REQUIRED IMPORTED_TARGET libdrm)
pkg_check_modules(GBM REQUIRED IMPORTED_TARGET gbm)
pkg_check_modules(LIBUDEV REQUIRED IMPORTED_TARGET libudev)

# static_library(name module archive...): an interface target for the static archives of a pkg-config module.
function(static_library name module)
    pkg_check_modules(${module} REQUIRED QUIET ${module})
    add_library(${name} INTERFACE)
    target_include_directories(${name} SYSTEM INTERFACE ${${module}_INCLUDE_DIRS})
    foreach(archive ${ARGN})
        find_library(${name}_${archive} NAMES lib${archive}.a REQUIRED)
        target_link_libraries(${name} INTERFACE ${${name}_${archive}})
    endforeach()
endfunction()

static_library(png_static libpng png z)
target_link_libraries(png_static INTERFACE m)
static_library(usb_static libusb-1.0 usb-1.0)
target_link_libraries(usb_static INTERFACE udev Threads::Threads)
static_library(gpiod_static libgpiod gpiod)
static_library(md_static libmd md)

# The typeface of all words on the screen, and what turns its outlines into pixels.
find_path(STB_INCLUDE stb/stb_truetype.h REQUIRED)
add_library(stb_headers INTERFACE)
target_include_directories(stb_headers SYSTEM INTERFACE ${STB_INCLUDE})
find_file(DEJAVU_SANS DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu REQUIRED NO_DEFAULT_PATH)

find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_path(TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)
add_library(toml_headers INTERFACE)
target_include_directories(toml_headers SYSTEM INTERFACE ${TOMLPLUSPLUS_INCLUDE})
