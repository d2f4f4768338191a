// Part of every program of the presets asan and tsan, so that it holds however the program is started.

extern "C" {

/// libEGL unloads Mesa's driver when the last display is closed. What the driver keeps to the end of the process (240 bytes with
/// Mesa 22.3) would then be called a leak, and of no library that could be named: it stays loaded. With that no leak of
/// Mesa's has to be suppressed, and llvmpipe's threads make no noise under the thread sanitizer.
int dlclose(void*) {
    return 0;
}

/// The undefined-behaviour sanitizer looks this up.
const char* __ubsan_default_options() {
    return "print_stacktrace=1";
}

}  // extern "C"
